import { render } from "preact";
import { act } from "preact/test-utils";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import type * as Api from "../../src/api";
import { Refused } from "../../src/api";
import { now, station } from "../../src/live";
import { StopButton, StopReport } from "../../src/parts/stop";
import { run, stationNow, stopClock } from "../samples";

const sent = vi.hoisted(() => vi.fn<typeof Api.stop>());
vi.mock("../../src/api", async (load) => ({ ...(await load<typeof Api>()), stop: sent }));

let place: HTMLElement;
const button = () => place.querySelector("button")!;
const report = () => place.querySelector("[role=alert]")!;
const press = () =>
  act(async () => {
    button().click();
    await new Promise((settled) => setTimeout(settled));
  });

beforeEach(async () => {
  sent.mockReset().mockResolvedValue({ axes: { "axis 1": null, "axis 2": null }, confirmed: true });
  station.value = stationNow();
  stopClock();
  place = document.body.appendChild(document.createElement("div"));
  await act(() =>
    render(
      <>
        <StopButton />
        <StopReport />
      </>,
      place,
    ),
  );
});

afterEach(() => {
  render(null, place);
  place.remove();
});

describe("stop", () => {
  it("is sent by one press, and reports that both drives confirmed", async () => {
    await press();
    expect(sent).toHaveBeenCalledTimes(1);
    expect(report().textContent).toContain("both drives confirmed");
    expect(report().className).not.toContain("alarm");
  });

  it("is sent again by every further press, whatever became of the first", async () => {
    sent.mockReturnValueOnce(new Promise(() => {}));
    await press();
    expect(report().textContent).toContain("Stopping");
    await press();
    expect(sent).toHaveBeenCalledTimes(2);
  });

  it("that an axis did not confirm is an alarm that names the axis", async () => {
    sent.mockResolvedValue({ axes: { "axis 1": null, "axis 2": "It does not answer." }, confirmed: false });
    await press();
    expect(report().textContent).toContain("axis 2: It does not answer. Press the emergency stop.");
    expect(report().className).toContain("alarm");
  });

  it("that fails is an alarm with its cause, and asks for the emergency stop", async () => {
    sent.mockRejectedValue(new Refused("The station does not respond."));
    await press();
    expect(report().textContent).toMatch(/STOP FAILED.*does not respond\..*emergency stop/);
    expect(report().className).toContain("alarm act");
  });

  it("is sent when the page is offline too, with a warning meanwhile", async () => {
    sent.mockReturnValueOnce(new Promise(() => {}));
    await act(() => {
      now.value += 60_000;
    });
    expect(button().disabled).toBe(false);
    await press();
    expect(sent).toHaveBeenCalledTimes(1);
    expect(report().textContent).toMatch(/Offline.*emergency stop/);
    expect(report().className).toContain("alarm act");
  });

  it("keeps its report when its run ends, until the next one starts", async () => {
    await act(() => {
      station.value = stationNow({ run: run({ id: 1 }) });
    });
    await press();
    await act(() => {
      station.value = stationNow();
    });
    expect(report().hasAttribute("hidden")).toBe(false);
    await act(() => {
      station.value = stationNow({ run: run() });
    });
    expect(report().hasAttribute("hidden")).toBe(true);
  });
});
