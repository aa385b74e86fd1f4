/** The diagnosis of a run: residual, causes, models, before and after, and detection limits. */
import { calibration, diagnosis, residuals } from "../../api";
import { micrometres } from "../../format";
import { t } from "../../messages";
import { readable } from "../../names";
import { BeforeAfter } from "../../parts/before-after";
import { Fold } from "../../parts/fold";
import { Link } from "../../parts/link";
import { useLoaded } from "../../parts/load";
import { reasonText } from "../../reason";
import type { Calibration, Diagnosis } from "../../types";
import { decisionOf } from "../result/decision";
import { DecisionLine } from "../result/decision-line";
import { NextStep } from "../result/next-step";
import { Causes, Hints, isTried } from "./causes";
import { Experiments } from "./experiments";
import { Explanations } from "./explanations";
import { Invisible } from "./invisible";
import { MistakeInData } from "./mistake";
import { ResidualOrderings } from "./residual-orderings";
import { SeparatingOffer } from "./separating";
import { Stages } from "./stages";
import { UseResult } from "./use-result";

export function DiagnosisView({ id }: { id: number }) {
  const ask = () => Promise.all([calibration(id), diagnosis(id), residuals(id)]);
  const { value, trouble } = useLoaded(`${id}`, ask).value;
  if (!value) {
    return (
      <section class="panel">
        <h1>{t.diagnosis.title}</h1>
        <p role="status">{trouble ?? t.shared.loading}</p>
      </section>
    );
  }
  const [run, found, left] = value;
  return (
    <div class="result">
      <DiagnosisSummary run={run} found={found} readings={left.items.length} />
      <NextStep result={run} experiments={found.experiments} />
      <MistakeInData found={found} />
      <ResidualOrderings id={id} found={found} residuals={left} />
      <Explanations found={found} />
      <Causes found={found} />
      <Experiments found={found} />
      <SeparatingOffer id={id} serial={run.robot_serial} found={found} />
      <Hints found={found} />
      {run.machine === "five-bar" && <UseResult id={id} />}
      <Fold name="models" title={t.diagnosis.errorsTitle}>
        <Stages found={found} />
        <BeforeAfter result={run} />
      </Fold>
      <Fold name="invisible" title={t.diagnosis.notFoundTitle}>
        <Invisible found={found} />
      </Fold>
    </div>
  );
}

export function DiagnosisSummary(props: { run: Calibration; found: Diagnosis; readings: number }) {
  const { run, found, readings } = props;
  const { sigma_mm, source, dof } = found.noise;
  const sigma = micrometres(sigma_mm, 2);
  const reason = reasonText(run);
  const said = decisionOf(run).sentence.toLowerCase();
  return (
    <section class="panel summary">
      <h1>{t.diagnosis.heading(run.id)}</h1>
      <DecisionLine result={run} />
      {reason && !reason.toLowerCase().endsWith(said) && <p>{reason}</p>}
      {run.reason === null && <p>{readable(found.sentence)}</p>}
      <p class="note">
        {t.verdicts[isTried(found) ? "unexplained" : found.verdict].text}{" "}
        {source === "repeats"
          ? t.diagnosis.noiseFromRepeats(readings, sigma, dof)
          : t.diagnosis.noiseSpecified(readings, sigma)}
        {found.outliers.length > 0 && ` ${t.diagnosis.outliers(t.listed(found.outliers.map(String)))}`}
      </p>
      <p class="actions">
        <Link class="button" to={`/result/${run.id}`}>
          {t.shared.result(run.id)}
        </Link>
        <a class="button" href={`/api/v1/calibrations/${run.id}/report.html?language=${t.language}`}>
          {t.shared.report}
        </a>
        <a class="button" href={`/api/v1/calibrations/${run.id}/readings.csv`} download>
          {t.shared.readingsCsv}
        </a>
      </p>
    </section>
  );
}
