import { render } from "preact";
import { act } from "preact/test-utils";
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import type * as Api from "../../../src/api";
import { confirm } from "../../../src/armed";
import { station } from "../../../src/live";
import { operator } from "../../../src/operator";
import { Prompt } from "../../../src/views/station/prompt";
import { run, stationNow, stopClock, summary } from "../../samples";

const sent = vi.hoisted(() => vi.fn<typeof Api.answer>());
vi.mock("../../../src/api", async (load) => ({ ...(await load<typeof Api>()), answer: sent }));

const ASKED = { id: "p1", text: "Read the level.", kind: "number" as const, unit: "deg", expires_at: "" };
let place: HTMLElement;
const shown = () => act(() => render(<Prompt />, place));
const press = () =>
  act(async () => {
    place.querySelector("button")!.click();
  });
const confirmed = () =>
  act(async () => {
    confirm();
  });

beforeEach(() => {
  sent.mockReset().mockResolvedValue(summary());
  stopClock();
  operator.value = "ada";
  place = document.body.appendChild(document.createElement("div"));
});

afterEach(() => {
  render(null, place);
  place.remove();
});

it("shows nothing while nothing is asked", async () => {
  station.value = stationNow({ run: run() });
  await shown();
  expect(place.textContent).toBe("");
});

it("asks for a number and sends it with the prompt it answers", async () => {
  const expires_at = new Date(Date.now() + 120_000).toISOString();
  station.value = stationNow({ run: run({ state: "waiting", prompt: { ...ASKED, expires_at } }) });
  await shown();
  expect(place.textContent).toContain("Read the level.");
  await press();
  await confirmed();
  expect(sent).not.toHaveBeenCalled();
  expect(place.querySelector("[role=alert]")!.textContent).toContain("Type a number");
  const field = place.querySelector("input")!;
  field.value = "0,125";
  await act(async () => {
    field.dispatchEvent(new Event("input", { bubbles: true }));
  });
  await press();
  expect(sent).not.toHaveBeenCalled();
  await confirmed();
  expect(sent).toHaveBeenCalledWith(2, "p1", 0.125, "ada");
});

it("asks for a confirmation without a field", async () => {
  const prompt = { ...ASKED, kind: "confirm" as const, unit: null, expires_at: new Date().toISOString() };
  station.value = stationNow({ run: run({ state: "waiting", prompt }) });
  await shown();
  expect(place.querySelector("input")).toBeNull();
  await press();
  expect(sent).not.toHaveBeenCalled();
  await confirmed();
  expect(sent).toHaveBeenCalledWith(2, "p1", null, "ada");
});
