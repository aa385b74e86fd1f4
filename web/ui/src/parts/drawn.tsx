import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { t } from "../messages";

interface Props {
  /** What the chart shows, for those who do not see it. */
  label: string;
  /** Drawn again whenever this changes. */
  on: string;
  /** Fetches what draws into a place and answers how to take it away. */
  load: () => Promise<(place: HTMLElement) => () => void>;
}

/** A place for a chart.  What draws it comes when it is needed, not with the page. */
export function Drawn({ label, on, load }: Props) {
  const place = useRef<HTMLDivElement>(null);
  const trouble = useSignal(false);
  useEffect(() => {
    let remove = () => {};
    let gone = false;
    load().then(
      (draw) => {
        trouble.value = false;
        // of two that were asked for one after the other only the last may draw here
        if (!gone && place.current) remove = draw(place.current);
      },
      // the station went down before it had sent what draws
      () => {
        trouble.value = true;
      },
    );
    return () => {
      gone = true;
      remove();
    };
  }, [on]);
  return (
    <>
      <div ref={place} class="chart" role="img" aria-label={label} />
      <p class="note" role="status" hidden={!trouble.value}>
        {t.shared.chartMissing}
      </p>
    </>
  );
}
