/** Two steps for what writes or forgets: press, then confirm.  Nothing is replaced while it updates. */
import { useSignal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { t } from "../messages";

interface Props {
  label: string;
  /** What will happen, in a sentence. */
  children: ComponentChildren;
  disabled: boolean;
  /** What is to be done next, rather than what may be. */
  prominent?: boolean;
  act: () => Promise<unknown>;
}

export function ConfirmedButton({ label, children, disabled, prominent, act }: Props) {
  const armed = useSignal(false);
  const sending = useSignal(false);
  const trouble = useSignal<string | null>(null);
  const button = useRef<HTMLButtonElement>(null);
  const confirmButton = useRef<HTMLButtonElement>(null);
  const wasArmed = useRef(false);

  useEffect(() => {
    // only now is the button enabled again and can take the focus
    if (armed.value) confirmButton.current?.focus();
    else if (wasArmed.current) button.current?.focus();
    wasArmed.current = armed.value;
  }, [armed.value]);
  useEffect(() => {
    if (disabled) armed.value = false;
  }, [disabled]);

  const confirm = async () => {
    if (sending.value) return;
    sending.value = true;
    trouble.value = await act().then(
      () => null,
      (error: Error) => error.message,
    );
    sending.value = false;
    armed.value = false;
  };
  return (
    <div class="confirmed">
      <button
        type="button"
        class={prominent ? "act" : undefined}
        ref={button}
        disabled={disabled || armed.value}
        onClick={() => {
          trouble.value = null;
          armed.value = true;
        }}
      >
        {label}
      </button>
      <div class="confirm" role="group" aria-label={t.shared.confirmLabel(label)} hidden={!armed.value}>
        <p>{children}</p>
        <button
          class="act"
          type="button"
          ref={confirmButton}
          disabled={disabled || sending.value}
          onKeyDown={(event) => event.repeat && event.preventDefault()}
          onClick={() => void confirm()}
        >
          {t.shared.confirm}
        </button>
        <button
          type="button"
          onClick={() => {
            armed.value = false;
          }}
        >
          {t.shared.back}
        </button>
      </div>
      <p class="trouble" role="alert">
        {trouble.value && `▲ ${trouble.value}`}
      </p>
    </div>
  );
}
