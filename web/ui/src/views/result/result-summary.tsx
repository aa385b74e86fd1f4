/** The head of a result: the decision in large type, the applied limit, the zeros in the drives. */
import { dateTime, duration, MISSING } from "../../format";
import { t } from "../../messages";
import { methodName, planOf, runKind } from "../../names";
import { Link } from "../../parts/link";
import type { Calibration } from "../../types";
import { decisionOf } from "./decision";
import { DecisionLine, WantedLine } from "./decision-line";
import { DriveState } from "./drive-state";

export function ResultSummary({ result }: { result: Calibration }) {
  const { id, of, robot_serial } = result;
  const kind = runKind(result.kind);
  return (
    <section class="panel summary">
      <div class="heading">
        <h1>{of === null ? t.result.heading(id) : t.result.headingOf(id, kind.name, of)}</h1>
        <span class="serial">{robot_serial}</span>
      </div>
      <DecisionLine result={result} />
      <WantedLine result={result} />
      <DriveState result={result} />
    </section>
  );
}

/** The run, its operator and time, with links to its other pages. */
export function RunFacts({ result }: { result: Calibration }) {
  const kind = runKind(result.kind);
  const plan = planOf(result.plan);
  const { verdict } = decisionOf(result).look;
  return (
    <div class="summary">
      <p class="note">
        {(plan ?? kind).text} {decisionOf(result).look.text} {verdict && t.shared.verdict(verdict)}
      </p>
      <dl>
        <Fact name={t.result.kind} value={kind.name} />
        {plan && <Fact name={t.result.plan} value={plan.name} />}
        <Fact name={t.shared.operator} value={result.operator} />
        {result.work_order && <Fact name={t.result.workOrder} value={result.work_order} />}
        <Fact name={t.result.started} value={dateTime(result.started_at ?? result.created_at)} />
        <Fact name={t.result.duration} value={took(result)} />
        {result.method && <Fact name={t.result.method} value={methodName(result.method)} />}
      </dl>
    </div>
  );
}

/** Links from a result to the other pages of its run and its robot. */
export function Ways({
  result: { id, of, kind, method, robot_serial, state, verdict, ended_at, machine },
}: {
  result: Calibration;
}) {
  const diagnosed = method === "diagnosis";
  return (
    <p class="actions wide">
      {of !== null && (
        <Link class="button" to={`/result/${of}`}>
          {t.shared.result(of)}
        </Link>
      )}
      {diagnosed && (
        <Link class="button" to={`/diagnosis/${id}`}>
          {t.result.diagnosis}
        </Link>
      )}
      {diagnosed && (
        <a class="button" href={`/api/v1/calibrations/${id}/report.html?language=${t.language}`}>
          {t.shared.report}
        </a>
      )}
      {kind === "gauge_study" &&
        state === "succeeded" &&
        ["html", "pdf", "json"].map((form) => (
          <a key={form} class="button" href={`/api/v1/calibrations/${id}/gauge-study.${form}`}>
            {t.result.gaugeStudy(form.toUpperCase())}
          </a>
        ))}
      {verdict &&
        ended_at &&
        machine === "five-bar" &&
        ["html", "pdf", "json"].map((form) => <CertificateLink key={form} id={id} form={form} />)}
      <a class="button" href={`/api/v1/calibrations/${id}/readings.csv`} download>
        {t.shared.readingsCsv}
      </a>
      <Link class="button" to={`/history?robot_serial=${encodeURIComponent(robot_serial)}`}>
        {t.result.robotHistory}
      </Link>
    </p>
  );
}

function CertificateLink({ id, form }: { id: number; form: string }) {
  const inLanguage = form === "json" ? "" : `?language=${t.language}`;
  return (
    <a class="button" href={`/api/v1/calibrations/${id}/certificate.${form}${inLanguage}`}>
      {t.result.certificate(form.toUpperCase())}
    </a>
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
