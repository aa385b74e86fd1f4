/** Process control: outcomes of runs, and the trend of each quantity. */
import { quality, trend } from "../../api";
import { fixed, percent } from "../../format";
import { t } from "../../messages";
import { effectName, inSentence, shown } from "../../names";
import { Drawn } from "../../parts/drawn";
import { useLoaded } from "../../parts/load";
import { reasonName } from "../../reason";
import type { ChartLines, Quality, Trend } from "../../types";
import type { Charted } from "./trend-drawing";

interface Props {
  serial: string | null;
  type: string | null;
  latest: string;
}

export function Process({ serial, type, latest }: Props) {
  const of = `${serial} ${type} ${latest}`;
  const { value: ended } = useLoaded(`pareto ${of}`, () => quality(serial, type)).value;
  const { value: moved, trouble } = useLoaded(`trend ${of}`, () => trend(serial, type)).value;
  return (
    <section class="panel process" aria-label={t.history.process}>
      <h2>{title(serial, type)}</h2>
      {ended && <Pareto ended={ended} />}
      {trouble && <p role="status">{t.history.trouble(trouble)}</p>}
      {moved && (
        <div class="pair">
          <Quantity name={t.history.offsetTrend(1)} moved={moved} charted={measured(moved, "dtheta1", "°")} />
          <Quantity name={t.history.offsetTrend(2)} moved={moved} charted={measured(moved, "dtheta2", "°")} />
          <Quantity
            name={t.history.errorTrend}
            moved={moved}
            charted={measured(moved, "position_error", "mm")}
          />
          {moved.effects.map((effect) => (
            <Effect key={`${effect.effect} ${effect.joint} ${effect.part}`} effect={effect} moved={moved} />
          ))}
        </div>
      )}
    </section>
  );
}

function title(serial: string | null, type: string | null): string {
  if (serial) return t.history.processOf(serial);
  return type ? t.history.processOfType(type) : t.history.processOfAll;
}

/** Outcomes with their reasons, most frequent first. */
function Pareto({ ended }: { ended: Quality }) {
  const all = Math.max(ended.runs, 1);
  const outcomes: Record<string, { name: string }> = t.outcomes;
  return (
    <table class="pareto">
      <caption>{t.history.pareto(ended.runs)}</caption>
      <tbody>
        {ended.pareto.map(({ outcome, reason_code, count }) => (
          <tr key={`${outcome} ${reason_code}`}>
            <th scope="row" class="text">
              {endedWith((outcome && outcomes[outcome]?.name) ?? t.shared.noVerdict, reason_code)}
            </th>
            <td>{count}</td>
            <td>{percent(count / all)}</td>
            <td class="share">
              <progress max={all} value={count} aria-label={t.history.share} />
            </td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

/** Some reasons begin with the outcome's name. */
function endedWith(outcome: string, code: string | null): string {
  if (!code) return outcome;
  const reason = reasonName(code);
  return reason.startsWith(outcome) ? reason : `${outcome}: ${reason}`;
}

const VALUE = {
  dtheta1: "dtheta1_deg",
  dtheta2: "dtheta2_deg",
  position_error: "position_error_mm",
} as const;

function measured(moved: Trend, of: keyof typeof VALUE, unit: string): Charted {
  const lines = moved[of];
  const inChart = new Set(lines.at);
  const points = moved.items.flatMap((item): [number, number][] => {
    const value = item[VALUE[of]];
    return inChart.has(item.id) && value !== null ? [[item.id, value]] : [];
  });
  return { points, lines, unit };
}

/** The trend of an effect's size over the runs that found it. */
function Effect({ effect, moved }: { effect: Trend["effects"][number]; moved: Trend }) {
  const sizes = effect.values.map((value) =>
    shown({ name: effect.parameter, value, sd: null, unit: effect.unit }),
  );
  const scale = (value: number | null) =>
    shown({ name: effect.parameter, value, sd: null, unit: effect.unit }).value;
  const lines = { ...effect.lines };
  for (const line of ["centre", "low", "high", "range_centre", "range_high"] as const) {
    lines[line] = scale(lines[line]);
  }
  const points = effect.lines.at.map((run, n): [number, number] => [run, sizes[n]?.value ?? Number.NaN]);
  const { name, unit } = sizes[0]!;
  return (
    <Quantity
      name={t.history.effectTrend(effectName({ label: "", depends_on: null, ...effect }), inSentence(name))}
      moved={moved}
      charted={{ points, lines, unit }}
    />
  );
}

function Quantity({ name, moved, charted }: { name: string; moved: Trend; charted: Charted }) {
  const { lines, points, unit } = charted;
  return (
    <figure>
      <figcaption>{name}</figcaption>
      {lines.centre === null ? (
        <p class="note">{t.history.fewValues}</p>
      ) : (
        <>
          <Drawn
            label={t.history.trendChart(name)}
            on={`${name} ${points.join(" ")}`}
            load={() =>
              import("./trend-drawing").then(
                ({ draw }) =>
                  (place) =>
                    draw(place, moved, charted),
              )
            }
          />
          <p class="note">{t.history.limits(fixed(lines.low, 3), fixed(lines.high, 3), unit)}</p>
          <Broken lines={lines} />
        </>
      )}
    </figure>
  );
}

/** Broken rules and their runs, in words: the chart has only shapes. */
function Broken({ lines }: { lines: ChartLines }) {
  const names: Record<string, string> = t.history.rules;
  const rules = [...new Set(lines.rules.map((rule) => rule.name))];
  const runsOf = (rule: string) =>
    lines.rules.filter(({ name }) => name === rule).map(({ at }) => String(at));
  if (rules.length === 0) return <p class="note">{t.history.noRule}</p>;
  return (
    <ul>
      {rules.map((rule) => (
        <li key={rule}>
          ◆ {names[rule] ?? rule}: {t.history.atRuns(t.listed(runsOf(rule)))}
        </li>
      ))}
    </ul>
  );
}
