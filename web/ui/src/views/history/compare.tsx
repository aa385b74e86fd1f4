/** Two runs side by side: zero offsets with their difference, and the fit of each. */
import { calibration } from "../../api";
import { expanded, fixed, MISSING, micrometres, signed } from "../../format";
import { t } from "../../messages";
import { Link } from "../../parts/link";
import { useLoaded } from "../../parts/load";
import { navigate, query } from "../../router";
import type { Calibration } from "../../types";
import { hasMap } from "../result/error-maps";
import { ResidualChart } from "../result/residual-chart";
import { address, showing } from "./address";
import { MapDifference } from "./map-difference";

export function Compare({ a, b }: { a: string | null; b: string | null }) {
  if (a === null) return null;
  const close = () =>
    navigate(address(showing(showing(query.value, "a", null), "b", null)), { replace: true });
  return (
    <section class="panel" aria-label={t.history.comparison}>
      <h2>{t.history.comparison}</h2>
      {b === null ? <p role="status">{t.history.chooseSecond(a)}</p> : <Both key={`${a} ${b}`} a={a} b={b} />}
      <p class="actions">
        <button type="button" onClick={close}>
          {t.history.endComparison}
        </button>
      </p>
    </section>
  );
}

function Both({ a, b }: { a: string; b: string }) {
  const { value: runs, trouble } = useLoaded(`${a} ${b}`, () =>
    Promise.all([calibration(Number(a)), calibration(Number(b))]),
  ).value;
  if (!runs) return <p role="status">{trouble ?? t.shared.loading}</p>;
  const [first, second] = runs;
  return (
    <>
      <Numbers first={first} second={second} />
      <div class="pair">
        {[
          [first, second],
          [second, first],
        ].map(
          ([run, other]) =>
            run!.residuals.length > 0 && (
              <figure key={run!.id}>
                <figcaption>{t.history.residualsOf(run!.id)}</figcaption>
                <ResidualChart id={run!.id} residuals={run!.residuals} beside={other!.residuals} />
              </figure>
            ),
        )}
      </div>
      {hasMap(first) && hasMap(second) && <MapDifference a={first.id} b={second.id} />}
    </>
  );
}

function Numbers({ first, second }: { first: Calibration; second: Calibration }) {
  const runs = [first, second];
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label={t.history.comparison}>
      <table>
        <thead>
          <tr>
            <th scope="col" class="text">
              {t.history.quantity}
            </th>
            {runs.map((run) => (
              <th key={run.id} scope="col">
                <Link to={`/result/${run.id}`} class="cell">
                  {t.history.runOf(run.id, run.robot_serial)}
                </Link>
              </th>
            ))}
            <th scope="col">{t.history.difference}</th>
          </tr>
        </thead>
        <tbody>
          {[1, 2].map((joint) => (
            <tr key={joint}>
              <th scope="row" class="text">
                {t.history.offset(joint)}
              </th>
              <td>{offset(first, joint)}</td>
              <td>{offset(second, joint)}</td>
              <td>{difference(first, second, joint)}</td>
            </tr>
          ))}
          <tr>
            <th scope="row" class="text">
              {t.history.residualRms}
            </th>
            {runs.map((run) => (
              <td key={run.id}>{micrometres(rms(run), 1)}</td>
            ))}
            <td>{micrometres(less(rms(second), rms(first)), 1)}</td>
          </tr>
          <tr>
            <th scope="row" class="text">
              {t.history.residualMax}
            </th>
            {runs.map((run) => (
              <td key={run.id}>{micrometres(largest(run), 1)}</td>
            ))}
            <td>{micrometres(less(largest(second), largest(first)), 1)}</td>
          </tr>
        </tbody>
      </table>
    </div>
  );
}

const zero = (run: Calibration, joint: number) => run.zero_offsets.find((one) => one.joint === joint);

const withU = (value: number | null, sd: number | null) => `${signed(value, 4)} ± ${fixed(expanded(sd), 4)}`;

function offset(run: Calibration, joint: number): string {
  const found = zero(run, joint);
  return found ? withU(found.value_deg, found.sd_deg) : MISSING;
}

/** The second less the first; the errors of the two runs are independent. */
function difference(first: Calibration, second: Calibration, joint: number): string {
  const [before, after] = [zero(first, joint), zero(second, joint)];
  if (!before || !after) return MISSING;
  const sd = before.sd_deg === null || after.sd_deg === null ? null : Math.hypot(before.sd_deg, after.sd_deg);
  return withU(less(after.value_deg, before.value_deg), sd);
}

const sizes = (run: Calibration) => run.residuals.flatMap((row) => row.residual_mm ?? []);

function rms(run: Calibration): number | null {
  const found = sizes(run);
  return found.length > 0 ? Math.hypot(...found) / Math.sqrt(found.length) : null;
}

function largest(run: Calibration): number | null {
  const found = sizes(run);
  return found.length > 0 ? Math.max(...found.map(Math.abs)) : null;
}

const less = (after: number | null, before: number | null) =>
  after === null || before === null ? null : after - before;
