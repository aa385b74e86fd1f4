import { render } from "preact";
import { act } from "preact/test-utils";
import { afterEach, expect, it, vi } from "vitest";
import { commandsCsv, targetsOf } from "../../../src/views/diagnosis/targets";
import { UseResult } from "../../../src/views/diagnosis/use-result";

const solution = {
  commands: [{ theta1_deg: 30.1234, theta2_deg: 150 }],
  range: "Learned on joint 1, with gear_cyclic of joint 1.",
  range_said: { code: "of_a_newer_version", params: {} },
  confirmed: false,
};

afterEach(() => void vi.unstubAllGlobals());

it("targets are two numbers a line, or four with the approaches", () => {
  expect(targetsOf("10 -700\n\n 20; -710, 1 -1 ").targets).toEqual([
    { x_mm: 10, y_mm: -700, approach1: 0, approach2: 0 },
    { x_mm: 20, y_mm: -710, approach1: 1, approach2: -1 },
  ]);
  for (const line of ["10", "10 a", "10 20 1", "10 20 2 1", "10 20 1 1 1"]) {
    expect(targetsOf(`1 2\n${line}`)).toEqual({ targets: [], wrong: 2 });
  }
});

it("commands are saved beside their targets", () =>
  expect(commandsCsv(targetsOf("10 -700").targets, solution).split("\n")).toEqual([
    "x_mm,y_mm,theta1_deg,theta2_deg",
    "10,-700,30.1234,150",
    "",
  ]));

async function asked(text: string, answer: Response) {
  vi.stubGlobal("fetch", () => Promise.resolve(answer));
  const place = document.createElement("div");
  render(<UseResult id={3} />, place);
  const field = place.querySelector("textarea")!;
  field.value = text;
  await act(() => void field.dispatchEvent(new Event("input", { bubbles: true })));
  await act(async () => {
    place.querySelector("form")!.dispatchEvent(new Event("submit", { bubbles: true, cancelable: true }));
    await new Promise((done) => setTimeout(done));
  });
  return place;
}

it("shows the commands, on what the model was learned, and that fresh readings refuted it", async () => {
  const place = await asked("10 -700", Response.json(solution));
  expect([...place.querySelectorAll("td")].map((cell) => cell.textContent)).toEqual([
    "10.000",
    "\u2212700.000",
    "30.1234",
    "150.0000",
  ]);
  expect(place.textContent).toContain("gear ripple of joint 1");
  expect(place.textContent).toContain("Fresh readings contradict this model.");
});

it("names the line that is no target, and why the station refuses one", async () => {
  expect((await asked("10", Response.json({}))).querySelector("[role=alert]")?.textContent).toContain(
    "Line 1",
  );
  expect((await asked(" ", Response.json({}))).querySelector("[role=alert]")?.textContent).toContain(
    "at least one",
  );
  const refused = Response.json({ detail: "Target 1 is out of reach." }, { status: 422 });
  const place = await asked("9999 0", refused);
  expect(place.querySelector("[role=alert]")?.textContent).toContain("Target 1 is out of reach.");
  expect(place.querySelector("table")).toBeNull();
});
