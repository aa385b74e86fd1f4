/** The scale of both maps, with the limit marked. */
import { fixed, significant } from "../../format";
import { t } from "../../messages";
import { colour, type Scale } from "./colours";

const STEPS = 40;
const WIDTH = 1000;
/** Ticks nearer to each other than this would overlap. */
const APART = 0.06;
/** From here on a mark's text is before it: there is no space after it. */
const RIGHT = 0.5;

export function ScaleBar({ scale, limit }: { scale: Scale; limit: number | null }) {
  const at = (mm: number) => scale.share(mm);
  const ticks = scale.ticks.filter((tick, k) => k === 0 || at(tick) - at(scale.ticks[k - 1]!) > APART);
  const limitMark = t.result.map.limitMark(fixed(limit, 3));
  return (
    <div class="scale-bar" role="img" aria-label={t.result.map.scale(plain(scale.low), plain(scale.high))}>
      <svg viewBox={`0 0 ${WIDTH} 22`} preserveAspectRatio="none" aria-hidden="true">
        {Array.from({ length: STEPS }, (_, k) => (
          <rect
            key={k}
            x={(k * WIDTH) / STEPS}
            width={WIDTH / STEPS + 1}
            height="22"
            fill={colour((k + 0.5) / STEPS)}
          />
        ))}
      </svg>
      {ticks.map((tick) => (
        <span key={tick} class="tick" style={{ left: `${100 * at(tick)}%` }}>
          {plain(tick)}
        </span>
      ))}
      {limit !== null && (
        <span class={at(limit) > RIGHT ? "mark before" : "mark"} style={{ left: `${100 * at(limit)}%` }}>
          {at(limit) > RIGHT ? `${limitMark} ▼` : `▼ ${limitMark}`}
        </span>
      )}
      <span class="unit">{t.result.map.unit}</span>
    </div>
  );
}

const plain = (mm: number) => significant(mm, 2);
