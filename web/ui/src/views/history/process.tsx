/** Is the process under control?  What runs ended with, and the trend of each quantity. */
import { quality, trend } from "../../api";
import { fixed, percent } from "../../format";
import { t } from "../../messages";
import { Drawn } from "../../parts/drawn";
import { useLoaded } from "../../parts/load";
import type { ChartLines, Quality, Trend } from "../../types";

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
          <Quantity name={t.history.offsetTrend(1)} unit="°" of="dtheta1" moved={moved} />
          <Quantity name={t.history.offsetTrend(2)} unit="°" of="dtheta2" moved={moved} />
          <Quantity name={t.history.errorTrend} unit="mm" of="position_error" moved={moved} />
        </div>
      )}
    </section>
  );
}

function title(serial: string | null, type: string | null): string {
  if (serial) return t.history.processOf(serial);
  return type ? t.history.processOfType(type) : t.history.processOfAll;
}

/** Outcomes with their reasons, the most frequent first. */
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
              {(outcome && outcomes[outcome]?.name) ?? t.shared.noVerdict}
              {reason_code && `: ${t.history.reasonName(reason_code)}`}
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

type Charted = "dtheta1" | "dtheta2" | "position_error";

function Quantity({ name, unit, of, moved }: { name: string; unit: string; of: Charted; moved: Trend }) {
  const lines = moved[of];
  return (
    <figure>
      <figcaption>{name}</figcaption>
      {lines.centre === null ? (
        <p class="note">{t.history.fewValues}</p>
      ) : (
        <>
          <Drawn
            label={t.history.trendChart(name)}
            on={`${of} ${lines.at.join(" ")}`}
            load={() =>
              import("./trend-drawing").then(
                ({ draw }) =>
                  (place) =>
                    draw(place, moved, of, unit),
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

/** Which rule is broken at which runs, in words: the chart has only shapes. */
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
