/**
 * A button that sends a request to the station; it cannot be pressed twice, and errors are shown beside it.
 */
import { useSignal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { connected } from "../../live";
import { t } from "../../messages";

interface Props {
  children: ComponentChildren;
  label?: string;
  disabled?: boolean;
  prominent?: boolean;
  act: () => Promise<unknown>;
}

export function ActionButton({ children, label, disabled, prominent, act }: Props) {
  const working = useSignal(false);
  const trouble = useSignal<string | null>(null);
  const press = async () => {
    working.value = true;
    trouble.value = await act().then(
      () => null,
      (error: Error) => error.message,
    );
    working.value = false;
  };
  return (
    <div class="action">
      <button
        type="button"
        class={prominent ? "act" : undefined}
        aria-label={label}
        disabled={disabled || working.value || !connected.value}
        onClick={() => void press()}
      >
        {children}
      </button>
      <p class={trouble.value ? "trouble" : "note"} role="status">
        {trouble.value ? `▲ ${trouble.value}` : working.value && t.maintenance.working}
      </p>
    </div>
  );
}

/** Shown while data are being loaded, or cannot be loaded. */
export function Pending({ trouble }: { trouble: string | null }) {
  return (
    <p class="empty" role="status">
      {trouble ? `▲ ${trouble}` : t.shared.loading}
    </p>
  );
}
