/**
 * Two steps for actions that move, write or delete: press, then confirm. No element is replaced during an
 * update.
 */
import { useSignal } from "@preact/signals";
import type { ComponentChildren, RefObject } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { arm, armed, confirm, disarm, secondsLeft } from "../armed";
import { t } from "../messages";
import { HoldButton } from "./hold";

/** A scan restores a field; only a value that stays changed for longer was entered by a person. */
const MEANT_MS = 60;

interface Props {
  label: string;
  /** The consequence, in a sentence. */
  children: ComponentChildren;
  disabled: boolean;
  /** The recommended next action, not one of several. */
  prominent?: boolean;
  act: () => Promise<unknown>;
  /** Before the question is shown: whether it is needed. */
  check?: () => boolean;
  /** The object of the question; another one withdraws it. */
  about?: string;
  button?: RefObject<HTMLButtonElement | null>;
}

export function ConfirmedButton({ label, children, disabled, prominent, act, check, about, button }: Props) {
  const sending = useSignal(false);
  const trouble = useSignal<string | null>(null);
  const own = useRef<HTMLButtonElement>(null);
  const first = button ?? own;
  const holding = useRef<HTMLButtonElement>(null);
  const wasAsked = useRef(false);
  const askedAbout = useRef(about);
  const aboutNow = useRef(about);
  aboutNow.current = about;
  const asked = armed.value?.by === first;

  useEffect(() => {
    // only now is the button enabled again and can take the focus
    if (asked) holding.current?.focus();
    else if (wasAsked.current && !holding.current?.ownerDocument.activeElement?.matches("input, select")) {
      first.current?.focus();
    }
    wasAsked.current = asked;
  }, [asked]);
  useEffect(() => {
    if (disabled) disarm(first);
  }, [disabled]);
  useEffect(() => {
    if (!wasAsked.current || about === askedAbout.current) return;
    const timer = setTimeout(() => disarm(first), MEANT_MS);
    return () => clearTimeout(timer);
  }, [about]);
  useEffect(() => () => disarm(first), []);

  const send = async () => {
    sending.value = true;
    trouble.value = await act().then(
      () => null,
      (error: Error) => error.message,
    );
    sending.value = false;
  };
  // a scan has changed a field until its restored value is drawn; drawing is pending already
  const confirmed = () =>
    queueMicrotask(() => {
      if (aboutNow.current === askedAbout.current) void send();
    });
  return (
    <div class="confirmed">
      <button
        type="button"
        class={prominent ? "act" : undefined}
        ref={first}
        disabled={disabled || sending.value || asked}
        onClick={() => {
          trouble.value = null;
          askedAbout.current = about;
          if (check?.() ?? true) arm(first, confirmed);
        }}
      >
        {label}
      </button>
      <div class="confirm" role="group" aria-label={t.shared.confirmLabel(label)} hidden={!asked}>
        <p>{children}</p>
        <HoldButton disabled={!asked} button={holding} held={() => confirm(first)}>
          {t.shared.confirm}
          <small>{t.shared.hold}</small>
        </HoldButton>
        <button type="button" onClick={() => disarm(first)}>
          {t.shared.back}
        </button>
        <p class="note">{asked && t.shared.armedFor(secondsLeft.value)}</p>
      </div>
      <p class="trouble" role="alert">
        {trouble.value && `▲ ${trouble.value}`}
      </p>
    </div>
  );
}
