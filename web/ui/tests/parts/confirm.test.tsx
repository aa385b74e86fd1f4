import { render } from "preact";
import { act } from "preact/test-utils";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { arm, armed, confirm, disarm } from "../../src/armed";
import { ConfirmedButton } from "../../src/parts/confirm";

let place: HTMLElement;
const done = vi.fn<() => Promise<unknown>>();

const draw = (given: { disabled?: boolean; about?: string; check?: () => boolean } = {}) =>
  act(() =>
    render(
      <ConfirmedButton label="Apply" disabled={false} act={done} {...given}>
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
const confirmed = () =>
  act(async () => {
    confirm();
    await new Promise((settled) => setTimeout(settled));
  });
const asked = () => !place.querySelector<HTMLElement>("[role=group]")?.hidden;

beforeEach(async () => {
  disarm();
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
    await confirmed();
    await confirmed();
    expect(done).toHaveBeenCalledTimes(1);
    expect(asked()).toBe(false);
    expect(buttons()).toEqual(before);
    expect(document.activeElement).toBe(before[0]);
  });

  it("does not act at a press of Confirm", async () => {
    const [first, confirmButton] = buttons();
    await press(first);
    await press(confirmButton);
    expect(done).not.toHaveBeenCalled();
    expect(asked()).toBe(true);
  });

  it("cannot be asked again while it acts", async () => {
    done.mockReturnValue(new Promise(() => {}));
    await press(buttons()[0]);
    await confirmed();
    expect(buttons()[0].disabled).toBe(true);
  });

  it("asks for one thing at a time", async () => {
    await press(buttons()[0]);
    const other = vi.fn();
    await act(() => arm({}, other));
    expect(asked()).toBe(false);
    await confirmed();
    expect(other).toHaveBeenCalledTimes(1);
    expect(done).not.toHaveBeenCalled();
  });

  it("does not ask what its check refuses", async () => {
    await draw({ check: () => false });
    await press(buttons()[0]);
    expect(asked()).toBe(false);
  });

  it("withdraws the question when what it is about changes, but not when it changes back at once", async () => {
    await draw({ about: "FB-1" });
    await press(buttons()[0]);
    await draw({ about: "FB-1CONF" });
    await draw({ about: "FB-1" });
    await new Promise((later) => setTimeout(later, 100));
    expect(armed.value).not.toBeNull();
    await draw({ about: "FB-2" });
    await vi.waitFor(() => expect(armed.value).toBeNull());
  });

  it("does not act while what it is about is another thing", async () => {
    await draw({ about: "FB-1" });
    await press(buttons()[0]);
    await draw({ about: "FB-1CONF" });
    await confirmed();
    expect(done).not.toHaveBeenCalled();
  });

  it("withdraws the question when it leaves the page", async () => {
    await press(buttons()[0]);
    await act(() => render(null, place));
    expect(armed.value).toBeNull();
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
    await draw({ disabled: true });
    expect(asked()).toBe(false);
    await draw();
    expect(asked()).toBe(false);
  });

  it("shows why it was refused, until the next press", async () => {
    done.mockRejectedValue(new Error("A run is in progress."));
    const [first] = buttons();
    await press(first);
    await confirmed();
    expect(place.querySelector("[role=alert]")?.textContent).toBe("▲ A run is in progress.");
    await press(first);
    expect(place.querySelector("[role=alert]")?.textContent).toBe("");
  });
});
