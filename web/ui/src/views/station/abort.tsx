import { useSignal } from "@preact/signals";
import { abort } from "../../api";
import { connected, station } from "../../live";
import { t } from "../../messages";

/** Ends the active run. Stop does the same and more; this is the ordinary way. */
export function AbortButton() {
  const trouble = useSignal<string | null>(null);
  const id = station.value?.run?.id ?? null;
  const press = async () => {
    if (id === null) return;
    trouble.value = await abort(id).then(
      () => null,
      (error: Error) => error.message,
    );
  };
  return (
    <div class="abort">
      <button type="button" disabled={id === null || !connected.value} onClick={() => void press()}>
        {t.station.abort}
      </button>
      <p class="trouble" role="alert">
        {id !== null && trouble.value}
      </p>
    </div>
  );
}
