import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { t } from "../messages";

interface Props {
  /** Description of the chart for users who cannot see it. */
  label: string;
  /** Redrawn whenever this changes. */
  on: string;
  /** Loads a function that draws into a place and returns a function to remove the chart. */
  load: () => Promise<(place: HTMLElement) => () => void>;
}

/** A place for a chart. Its drawing code is loaded when it is needed, not with the page. */
export function Drawn({ label, on, load }: Props) {
  const place = useRef<HTMLDivElement>(null);
  const trouble = useSignal(false);
  useEffect(() => {
    let remove = () => {};
    let gone = false;
    load().then(
      (draw) => {
        trouble.value = false;
        // of two successive requests only the last may draw here
        if (!gone && place.current) remove = draw(place.current);
      },
      // the station went down before it had sent the drawing code
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
