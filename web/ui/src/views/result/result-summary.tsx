/** The head of a result: verdict, facts of the run, and where to go from here. */
import { dateTime, duration, MISSING } from "../../format";
import { t } from "../../messages";
import { methodName, planOf, runKind } from "../../names";
import { Link } from "../../parts/link";
import { outcomeOf, VerdictLine } from "../../parts/verdict";
import type { Calibration } from "../../types";

export function ResultSummary({ result }: { result: Calibration }) {
  const { id, of, method } = result;
  const kind = runKind(result.kind);
  const plan = planOf(result.plan);
  return (
    <section class="panel summary">
      <h1>{of === null ? t.result.heading(id) : t.result.headingOf(id, kind.name, of)}</h1>
      <VerdictLine run={result} />
      <p class="note">
        {(plan ?? kind).text} {outcomeOf(result).text}
      </p>
      <dl>
        <Fact name={t.result.kind} value={kind.name} />
        {plan && <Fact name={t.result.plan} value={plan.name} />}
        <Fact name={t.shared.operator} value={result.operator} />
        {result.work_order && <Fact name={t.result.workOrder} value={result.work_order} />}
        <Fact name={t.result.started} value={dateTime(result.started_at ?? result.created_at)} />
        <Fact name={t.result.duration} value={took(result)} />
        {method && <Fact name={t.result.method} value={methodName(method)} />}
      </dl>
      <Ways result={result} />
    </section>
  );
}

function Ways({ result: { id, of, method, robot_serial } }: { result: Calibration }) {
  const diagnosed = method === "diagnosis";
  return (
    <p class="actions">
      {of !== null && (
        <Link class="button" to={`/result/${of}`}>
          {t.shared.result(of)}
        </Link>
      )}
      <a class="button" href={`/api/v1/calibrations/${id}/readings.csv`} download>
        {t.shared.readingsCsv}
      </a>
      {diagnosed && (
        <Link class="button" to={`/diagnosis/${id}`}>
          {t.result.diagnosis}
        </Link>
      )}
      {diagnosed && (
        <a class="button" href={`/api/v1/calibrations/${id}/report.html`}>
          {t.shared.report}
        </a>
      )}
      <Link class="button" to={`/history?robot_serial=${encodeURIComponent(robot_serial)}`}>
        {t.result.robotHistory}
      </Link>
    </p>
  );
}

function Fact({ name, value }: { name: string; value: string }) {
  return (
    <div>
      <dt>{name}</dt>
      <dd>{value}</dd>
    </div>
  );
}

function took(result: Calibration): string {
  if (!result.started_at || !result.ended_at) return MISSING;
  return duration((Date.parse(result.ended_at) - Date.parse(result.started_at)) / 1000);
}
