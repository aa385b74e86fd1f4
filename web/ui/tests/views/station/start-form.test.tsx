import { render } from "preact";
import { act } from "preact/test-utils";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import type * as Api from "../../../src/api";
import { Refused } from "../../../src/api";
import { confirm, disarm, watchArmed } from "../../../src/armed";
import { now, station } from "../../../src/live";
import { operator } from "../../../src/operator";
import { chosenPlan, serial, takeSerial, trouble } from "../../../src/views/station/start";
import { StartForm } from "../../../src/views/station/start-form";
import { wishes } from "../../../src/views/station/wishes";
import { run, stationNow, stopClock, summary } from "../../samples";

const sent = vi.hoisted(() => vi.fn<typeof Api.start>());
vi.mock("../../../src/api", async (load) => ({
  ...(await load<typeof Api>()),
  start: sent,
  plan: () => new Promise(() => {}),
}));

let place: HTMLElement;
let unwatch: () => void;
const field = (id: string) => place.querySelector<HTMLInputElement>(`#${id}`)!;
const button = (text: string) =>
  [...place.querySelectorAll("button")].find((one) => one.textContent?.startsWith(text))!;
const press = (text: string) =>
  act(async () => {
    button(text).click();
    await new Promise((settled) => setTimeout(settled));
  });
const alert = () => place.querySelector("[role=alert]")?.textContent;
const asked = () => !place.querySelector<HTMLElement>("[role=group]")?.hidden;
const type = (id: string, text: string) =>
  act(() => {
    field(id).value = text;
    field(id).dispatchEvent(new Event("input", { bubbles: true }));
  });
const confirmed = () =>
  act(async () => {
    confirm();
    await new Promise((settled) => setTimeout(settled));
  });
/** As a person does: characters, then Enter. */
const enter = async (id: string, text: string) => {
  await type(id, text);
  await act(() => {
    place.querySelector("form")?.dispatchEvent(new Event("submit", { bubbles: true, cancelable: true }));
  });
};

beforeEach(async () => {
  sent.mockReset().mockResolvedValue(summary());
  serial.value = operator.value = "";
  chosenPlan.value = "paper";
  trouble.value = null;
  disarm();
  stopClock();
  station.value = stationNow();
  place = document.body.appendChild(document.createElement("div"));
  unwatch = watchArmed();
  await act(() => render(<StartForm />, place));
});

afterEach(() => {
  unwatch();
  render(null, place);
  place.remove();
});

describe("a start", () => {
  it("begins at the serial, and Enter leads from field to field", async () => {
    expect(document.activeElement).toBe(field("robot_serial"));
    await enter("robot_serial", "FB-1");
    expect(document.activeElement).toBe(field("operator"));
    await enter("operator", "ada");
    expect(document.activeElement).toBe(button("Calibrate"));
    expect(sent).not.toHaveBeenCalled();
  });

  it.each([
    ["", "ada", "robot_serial", "serial number"],
    ["  ", "ada", "robot_serial", "serial number"],
    ["FB-1", "", "operator", "operator"],
  ])("with serial %j and operator %j asks for the %s", async (serialText, who, id, words) => {
    await type("robot_serial", serialText);
    await type("operator", who);
    await press("Calibrate");
    expect(alert()).toContain(words);
    expect(field(id).getAttribute("aria-invalid")).toBe("true");
    expect(document.activeElement).toBe(field(id));
    expect(asked()).toBe(false);
  });

  it("asks before the robot moves, and names it", async () => {
    await type("robot_serial", " FB-1 ");
    await type("operator", "ada");
    await press("Calibrate");
    expect(asked()).toBe(true);
    expect(place.querySelector("[role=group]")?.textContent).toContain("Robot FB-1 will move");
    expect(document.activeElement).toBe(button("Confirm"));
    expect(sent).not.toHaveBeenCalled();
  });

  it("is sent once, trimmed, with a key, when it is confirmed", async () => {
    chosenPlan.value = "full";
    await type("robot_serial", " FB-1 ");
    await type("operator", "ada ");
    await press("Calibrate");
    await confirmed();
    await confirmed();
    expect(sent).toHaveBeenCalledTimes(1);
    const [body, key] = sent.mock.calls[0]!;
    expect(body).toEqual({ robot_serial: "FB-1", plan: "full", operator: "ada" });
    expect(key).toMatch(/^[0-9a-f]{32}$/);
    expect(asked()).toBe(false);
    expect(sessionStorage.getItem("operator")).toBe("ada");
  });
});

describe("an armed start", () => {
  beforeEach(async () => {
    await type("robot_serial", "FB-1");
    await type("operator", "ada");
    await press("Calibrate");
    expect(asked()).toBe(true);
  });

  it("is withdrawn by Back, and the focus returns", async () => {
    await press("Back");
    expect(asked()).toBe(false);
    expect(document.activeElement).toBe(button("Calibrate"));
  });

  it.each(["robot_serial", "operator"])("is withdrawn when the %s changes", async (id) => {
    await type(id, "other");
    await vi.waitFor(() => expect(asked()).toBe(false));
  });

  it("is withdrawn when the plan changes", async () => {
    const select = place.querySelector("select")!;
    await act(() => {
      select.value = "full";
      select.dispatchEvent(new Event("change", { bubbles: true }));
    });
    await vi.waitFor(() => expect(asked()).toBe(false));
    expect(place.textContent).toContain("eight further readings");
  });

  it.each([
    ["another run starts", () => Object.assign(station, { value: stationNow({ run: run() }) })],
    ["the station is lost", () => Object.assign(now, { value: now.value + 60_000 })],
  ])("is withdrawn when %s, and cannot be armed then", async (_, happens) => {
    await act(() => {
      happens();
    });
    expect(asked()).toBe(false);
    expect(button("Calibrate").disabled).toBe(true);
  });

  it("starts what it named, though the code of a scan stood in a field for a moment", async () => {
    serial.value = "FB-1CONFIRM";
    await Promise.resolve();
    serial.value = "FB-1";
    confirm();
    await vi.waitFor(() => expect(sent).toHaveBeenCalledTimes(1));
    expect(sent.mock.calls[0]![0].robot_serial).toBe("FB-1");
  });

  it("shows a refusal at its field, and is asked anew", async () => {
    sent.mockRejectedValueOnce(new Refused("The serial has a space.", "robot_serial", 422));
    await confirmed();
    expect(alert()).toBe("▲ The serial has a space.");
    expect(field("robot_serial").getAttribute("aria-invalid")).toBe("true");
    expect(field("operator").getAttribute("aria-invalid")).toBe("false");
    expect(asked()).toBe(false);
    expect(button("Calibrate").disabled).toBe(false);
  });

  it.each([
    ["has the same key after a lost answer", null, 1],
    ["has another key after a refusal", 409, 2],
  ])("%s", async (_, status, keys) => {
    sent.mockRejectedValueOnce(new Refused("No.", null, status));
    await confirmed();
    await press("Calibrate");
    await confirmed();
    expect(new Set(sent.mock.calls.map(([, key]) => key)).size).toBe(keys);
  });
});

describe("a scanned serial", () => {
  it("replaces the one before, and leads to what is missing", async () => {
    await act(() => takeSerial("FB-6"));
    await act(() => takeSerial("FB-7"));
    expect(field("robot_serial").value).toBe("FB-7");
    expect(document.activeElement).toBe(field("operator"));
    await type("operator", "ada");
    await act(() => takeSerial("FB-8"));
    expect(document.activeElement).toBe(button("Calibrate"));
  });

  it("forgets the references of another robot", async () => {
    await act(() => takeSerial("FB-6"));
    wishes.at.value = "0.1";
    await act(() => takeSerial("FB-6"));
    expect(wishes.at.value).toBe("0.1");
    await act(() => takeSerial("FB-7"));
    expect(wishes.at.value).toBe("");
  });
});

it("offers the plans that the station can run", () =>
  expect([...place.querySelectorAll("#plan option")].map((one) => one.textContent)).toEqual([
    "Paper",
    "Full (recommended)",
  ]));
