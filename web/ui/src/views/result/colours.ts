/**
 * The colours of the error maps: one scale for both, in order of lightness, also for colour-blind users
 * (viridis).
 */

const STOPS = [
  "#440154",
  "#482878",
  "#3e4989",
  "#31688e",
  "#26828e",
  "#1f9e89",
  "#35b779",
  "#6ece58",
  "#b5de2b",
  "#fde725",
].map((hex) => [1, 3, 5].map((at) => Number.parseInt(hex.slice(at, at + 2), 16)));

/** The colour of a share from 0 (dark) to 1 (light). */
export function colour(share: number): string {
  const at = Math.min(Math.max(share, 0), 1) * (STOPS.length - 1);
  const k = Math.min(Math.floor(at), STOPS.length - 2);
  const [low, high] = [STOPS[k]!, STOPS[k + 1]!];
  return `rgb(${low.map((c, i) => Math.round(c + (at - k) * (high[i]! - c))).join(" ")})`;
}

/** A logarithmic scale: errors before and after differ by a factor of a hundred. */
export interface Scale {
  low: number;
  high: number;
  share: (mm: number) => number;
  /** 1, 2, 5, 10 ... inside the scale. */
  ticks: number[];
}

const LEAST_RATIO = 1.5;

export function scaleOf(values: number[]): Scale {
  const positive = values.filter((value) => value > 0);
  const high = positive.length > 0 ? Math.max(...positive) : 1;
  const low = Math.min(...positive, high / LEAST_RATIO);
  const span = Math.log(high / low);
  const ticks: number[] = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); power++) {
    ticks.push(...[1, 2, 5].map((digit) => Number(`${digit}e${power}`)));
  }
  return {
    low,
    high,
    share: (mm) => Math.log(Math.max(mm, low) / low) / span,
    ticks: ticks.filter((tick) => tick >= low && tick <= high),
  };
}

/** From -most to +most in even steps; the middle is zero difference. */
export function evenScale(most: number): Scale {
  const size = most > 0 ? most : 1;
  return { low: -size, high: size, share: (mm) => (mm + size) / (2 * size), ticks: [-size, 0, size] };
}
