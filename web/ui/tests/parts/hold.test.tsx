import { render } from "preact";
import { act } from "preact/test-utils";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { HoldButton } from "../../src/parts/hold";

let place: HTMLElement;
const held = vi.fn();
const draw = (disabled = false) =>
  act(() =>
    render(
      <HoldButton disabled={disabled} held={held} button={{ current: null }}>
        Confirm
      </HoldButton>,
      place,
    ),
  );
const button = () => place.querySelector("button")!;
const key = (type: string, name: string, repeat = false) =>
  button().dispatchEvent(new KeyboardEvent(type, { key: name, repeat, bubbles: true, cancelable: true }));
const pointer = (type: string, given: PointerEventInit = {}) =>
  button().dispatchEvent(new PointerEvent(type, { isPrimary: true, bubbles: true, ...given }));

beforeEach(async () => {
  vi.useFakeTimers();
  held.mockReset();
  place = document.body.appendChild(document.createElement("div"));
  await draw();
  button().setPointerCapture = vi.fn();
});

afterEach(() => {
  render(null, place);
  place.remove();
  vi.useRealTimers();
});

describe("a button to hold", () => {
  it.each(["Enter", " "])("acts once after the key %j was down for a second", (name) => {
    key("keydown", name);
    for (let n = 0; n < 30; n++) key("keydown", name, true);
    vi.advanceTimersByTime(900);
    expect(held).not.toHaveBeenCalled();
    vi.advanceTimersByTime(2000);
    expect(held).toHaveBeenCalledTimes(1);
  });

  it("acts after a pointer has pressed it for a second", () => {
    pointer("pointerdown");
    vi.advanceTimersByTime(1100);
    expect(held).toHaveBeenCalledTimes(1);
  });

  it.each([
    ["the key is let go", () => key("keyup", "Enter")],
    ["the focus leaves", () => button().dispatchEvent(new FocusEvent("blur"))],
    ["another window comes up", () => dispatchEvent(new FocusEvent("blur"))],
    ["the pointer goes up", () => pointer("pointerup")],
    ["the pointer is cancelled", () => pointer("pointercancel")],
    ["the pointer slides off", () => pointer("pointermove", { clientX: 500, clientY: 500 })],
    ["it is disabled", () => draw(true)],
  ])("does nothing when %s before", async (_, ends) => {
    key("keydown", "Enter");
    vi.advanceTimersByTime(500);
    await ends();
    vi.advanceTimersByTime(5000);
    expect(held).not.toHaveBeenCalled();
  });

  it.each([
    ["a key that only repeats", () => key("keydown", "Enter", true)],
    ["another key", () => key("keydown", "a")],
    ["a click", () => button().click()],
    ["a second finger", () => pointer("pointerdown", { isPrimary: false })],
    ["another button of the mouse", () => pointer("pointerdown", { button: 2 })],
  ])("does nothing at %s", (_, happens) => {
    happens();
    vi.advanceTimersByTime(5000);
    expect(held).not.toHaveBeenCalled();
  });

  it("does not count the time in which the page could not hear that it was let go", () => {
    const clock = vi.spyOn(performance, "now");
    clock.mockReturnValue(0);
    key("keydown", "Enter");
    clock.mockReturnValue(3000);
    vi.advanceTimersByTime(50);
    expect(held).not.toHaveBeenCalled();
  });
});
