/** What the model of a run lacked: residual, causes, models, before and after, and what could not be seen. */
import { calibration, diagnosis, residuals } from "../../api";
import { fixed } from "../../format";
import { BeforeAfter } from "../../parts/before-after";
import { Causes, Hints } from "./causes";
import { Invisible } from "./invisible";
import { Link } from "../../parts/link";
import { useLoaded } from "../../parts/load";
import { ResidualOrderings } from "./residual-orderings";
import { SeparatingOffer } from "./separating";
import { Stages } from "./stages";
import { VerdictLine } from "../../parts/verdict";

const UM = 1000;

export function DiagnosisView({ id }: { id: number }) {
  const ask = () => Promise.all([calibration(id), diagnosis(id), residuals(id)]);
  const { value, trouble } = useLoaded(`${id}`, ask).value;
  if (!value) {
    return (
      <section class="panel">
        <h1>Diagnosis</h1>
        <p role="status">{trouble ?? "Loading …"}</p>
      </section>
    );
  }
  const [run, found, left] = value;
  const { sigma_mm, source, dof } = found.noise;
  return (
    <div class="result">
      <section class="panel summary">
        <h1>Diagnosis of run {id}</h1>
        <VerdictLine run={run} />
        <p>{found.sentence}</p>
        <p class="note">
          {left.items.length} readings. Noise of one reading {fixed(UM * sigma_mm, 2)} µm,{" "}
          {source === "repeats" ? `from ${dof} repeats` : "as specified"}.
          {found.outliers.length > 0 && ` Left out: reading ${found.outliers.join(", ")}.`}
        </p>
        <p class="actions">
          <Link class="button" to={`/result/${id}`}>
            Result {id}
          </Link>
          <a class="button" href={`/api/v1/calibrations/${id}/report.html`}>
            Report
          </a>
          <a class="button" href={`/api/v1/calibrations/${id}/readings.csv`} download>
            Readings (CSV)
          </a>
        </p>
      </section>
      <Causes found={found} />
      <SeparatingOffer id={id} serial={run.robot_serial} found={found} />
      <Hints found={found} />
      <ResidualOrderings id={id} residuals={left} />
      <Stages found={found} />
      <BeforeAfter result={run} wide />
      <Invisible found={found} />
    </div>
  );
}
