import { render } from "preact";
import { act } from "preact/test-utils";
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import type * as Api from "../../../src/api";
import { confirm } from "../../../src/armed";
import { station } from "../../../src/live";
import { operator } from "../../../src/operator";
import { Retract } from "../../../src/views/station/retract";
import { stationNow, stopClock, summary } from "../../samples";

const sent = vi.hoisted(() => vi.fn<typeof Api.retract>());
vi.mock("../../../src/api", async (load) => ({ ...(await load<typeof Api>()), retract: sent }));

const OUTSIDE = { needed: true, excess_mm: 91.2, text: "The arm stands 91.2 mm outside its workspace." };
let place: HTMLElement;
const shown = () => act(() => render(<Retract />, place));

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

it("is not offered while the arm stands inside", async () => {
  station.value = stationNow();
  await shown();
  expect(place.querySelector("section")!.hidden).toBe(true);
  expect(place.querySelector("button")).toBeNull();
});

it("is offered outside, says how far, and moves only after a confirmation", async () => {
  station.value = stationNow({ retract: OUTSIDE });
  await shown();
  expect(place.textContent).toContain("91.2 mm outside");
  await act(() => place.querySelector("button")!.click());
  expect(sent).not.toHaveBeenCalled();
  await act(() => {
    confirm();
  });
  expect(sent).toHaveBeenCalledWith("ada", expect.any(String));
});
