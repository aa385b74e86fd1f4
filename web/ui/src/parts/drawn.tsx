import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";

interface Props {
  /** What the chart shows, for those who do not see it. */
  label: string;
  /** Drawn again whenever this changes. */
  on: string;
  /** Draws into the place; answers how to take it away. */
  draw: (place: HTMLElement) => Promise<() => void>;
}

/** A place for a chart.  What draws it comes when it is needed, not with the page. */
export function Drawn({ label, on, draw }: Props) {
  const place = useRef<HTMLDivElement>(null);
  const trouble = useSignal(false);
  useEffect(() => {
    let remove = () => {};
    let gone = false;
    if (place.current) {
      draw(place.current).then(
        (taken) => {
          trouble.value = false;
          if (gone) taken();
          else remove = taken;
        },
        // the station went down before it had sent what draws
        () => (trouble.value = true),
      );
    }
    return () => {
      gone = true;
      remove();
    };
  }, [on]);
  return (
    <>
      <div ref={place} class="chart" role="img" aria-label={label} />
      <p class="note" role="status" hidden={!trouble.value}>
        ▲ The chart could not be loaded; load the page again.
      </p>
    </>
  );
}
