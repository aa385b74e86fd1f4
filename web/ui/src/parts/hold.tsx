/**
 * A button that has to be held for a second, with a finger, a glove, or a key; a short press does nothing.
 */
import { useSignal } from "@preact/signals";
import type { ComponentChildren, RefObject } from "preact";
import { useEffect, useRef } from "preact/hooks";

const HOLD_MS = 1000;
const TICK_MS = 50;

interface Props {
  children: ComponentChildren;
  disabled: boolean;
  held: () => void;
  button: RefObject<HTMLButtonElement | null>;
}

export function HoldButton({ children, disabled, held, button }: Props) {
  const part = useSignal(0);
  const timer = useRef<ReturnType<typeof setInterval> | null>(null);
  const end = () => {
    if (timer.current !== null) clearInterval(timer.current);
    timer.current = null;
    part.value = 0;
  };
  const begin = () => {
    if (timer.current !== null) return;
    let last = performance.now();
    let heldMs = 0;
    timer.current = setInterval(() => {
      const time = performance.now();
      // while the page was busy the finger may have left; the event arrives only afterwards
      heldMs += Math.min(time - last, 2 * TICK_MS);
      last = time;
      part.value = heldMs / HOLD_MS;
      if (heldMs < HOLD_MS) return;
      end();
      held();
    }, TICK_MS);
  };
  useEffect(() => {
    if (disabled) end();
    // another window may take the pointer and the keys without an event for the button
    addEventListener("blur", end);
    return () => {
      removeEventListener("blur", end);
      end();
    };
  }, [disabled]);
  return (
    <button
      type="button"
      class="act hold"
      ref={button}
      disabled={disabled}
      style={{ "--held": part.value }}
      onPointerDown={(event) => {
        if (!event.isPrimary || event.button !== 0) return;
        event.currentTarget.setPointerCapture(event.pointerId);
        begin();
      }}
      onPointerMove={(event) => {
        const box = event.currentTarget.getBoundingClientRect();
        const { clientX: x, clientY: y } = event;
        if (x < box.left || x > box.right || y < box.top || y > box.bottom) end();
      }}
      onPointerUp={end}
      onPointerCancel={end}
      onContextMenu={(event) => event.preventDefault()}
      onKeyDown={(event) => {
        if (event.key !== "Enter" && event.key !== " ") return;
        event.preventDefault();
        // a key that was pressed before, for another button, continues to repeat here
        if (!event.repeat) begin();
      }}
      onKeyUp={end}
      onBlur={end}
    >
      {children}
    </button>
  );
}
