/** How the last run ended; it stays until the next serial is scanned. */
import { signal } from "@preact/signals";
import { station } from "../live";
import { Link } from "./link";
import { VerdictLine } from "./verdict";

const dismissed = signal<number | null>(null);

export function dismissOutcome(): void {
  dismissed.value = station.value?.last?.id ?? null;
}

export function Outcome() {
  const now = station.value;
  const last = now?.run || now?.last?.id === dismissed.value ? null : now?.last;
  return (
    <section class="outcome" aria-label="Last run" aria-live="polite" hidden={!last}>
      {last && (
        <>
          <VerdictLine run={last} />
          <Link class="button" to={`/result/${last.id}`}>
            Result {last.id}
          </Link>
        </>
      )}
    </section>
  );
}
