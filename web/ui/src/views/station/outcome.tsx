/** The end of the last run, shown until the next serial is scanned. */
import { computed, signal } from "@preact/signals";
import { station } from "../../live";
import { t } from "../../messages";
import { Link } from "../../parts/link";
import { VerdictLine } from "../../parts/verdict";

const dismissed = signal<number | null>(null);

export const outcome = computed(() => {
  const last = station.value?.last;
  return station.value?.run || !last || last.id === dismissed.value ? null : last;
});

export function dismissOutcome(): void {
  dismissed.value = station.value?.last?.id ?? null;
}

export function Outcome() {
  const last = outcome.value;
  return (
    <div class="outcome" aria-live="polite" hidden={!last}>
      {last && (
        <>
          <VerdictLine run={last} />
          <Link class="button" to={`/result/${last.id}`}>
            {t.shared.result(last.id)}
          </Link>
        </>
      )}
    </div>
  );
}
