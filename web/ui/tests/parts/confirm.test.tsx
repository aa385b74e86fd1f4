import { render } from "preact";
import { act } from "preact/test-utils";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { ConfirmedButton } from "../../src/parts/confirm";

let place: HTMLElement;
const done = vi.fn<() => Promise<unknown>>();

const draw = (disabled = false) =>
  act(() =>
    render(
      <ConfirmedButton label="Apply" disabled={disabled} act={done}>
        Careful
      </ConfirmedButton>,
      place,
    ),
  );
const buttons = () =>
  [...place.querySelectorAll("button")] as [HTMLButtonElement, HTMLButtonElement, HTMLButtonElement];
const press = (button: HTMLButtonElement) =>
  act(async () => {
    button.click();
    await new Promise((settled) => setTimeout(settled));
  });
const asked = () => !place.querySelector<HTMLElement>("[role=group]")?.hidden;

beforeEach(async () => {
  done.mockReset().mockResolvedValue(null);
  place = document.body.appendChild(document.createElement("div"));
  await draw();
});

afterEach(() => {
  render(null, place);
  place.remove();
});

describe("a confirmed button", () => {
  it("does nothing at the first press but ask", async () => {
    const [first, confirm] = buttons();
    expect(asked()).toBe(false);
    await press(first);
    expect(asked()).toBe(true);
    expect(document.activeElement).toBe(confirm);
    expect(done).not.toHaveBeenCalled();
  });

  it("acts once when confirmed, with the buttons that were there", async () => {
    const before = buttons();
    await press(before[0]);
    await press(before[1]);
    expect(done).toHaveBeenCalledTimes(1);
    expect(asked()).toBe(false);
    expect(buttons()).toEqual(before);
    expect(document.activeElement).toBe(before[0]);
  });

  it("does not act twice while the first is under way", async () => {
    let finish = () => {};
    done.mockReturnValue(
      new Promise<void>((resolve) => {
        finish = resolve;
      }),
    );
    const [first, confirm] = buttons();
    await press(first);
    // both presses before anything is drawn again
    await act(async () => {
      confirm.click();
      confirm.click();
    });
    expect(done).toHaveBeenCalledTimes(1);
    await act(async () => finish());
  });

  it("goes back without acting", async () => {
    const [first, , back] = buttons();
    await press(first);
    await press(back);
    expect(asked()).toBe(false);
    expect(done).not.toHaveBeenCalled();
  });

  it("withdraws the question when it becomes disabled", async () => {
    await press(buttons()[0]);
    await draw(true);
    expect(asked()).toBe(false);
    await draw(false);
    expect(asked()).toBe(false);
  });

  it("shows why it was refused, until the next press", async () => {
    done.mockRejectedValue(new Error("A run is in progress."));
    const [first, confirm] = buttons();
    await press(first);
    await press(confirm);
    expect(place.querySelector("[role=alert]")?.textContent).toBe("▲ A run is in progress.");
    await press(first);
    expect(place.querySelector("[role=alert]")?.textContent).toBe("");
  });

  it("does not take a key that is held down for a confirmation", async () => {
    const [first, confirm] = buttons();
    await press(first);
    const held = new KeyboardEvent("keydown", {
      key: "Enter",
      repeat: true,
      cancelable: true,
      bubbles: true,
    });
    confirm.dispatchEvent(held);
    expect(held.defaultPrevented).toBe(true);
    const pressed = new KeyboardEvent("keydown", { key: "Enter", cancelable: true, bubbles: true });
    confirm.dispatchEvent(pressed);
    expect(pressed.defaultPrevented).toBe(false);
  });
});
