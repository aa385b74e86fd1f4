import { calibration, type Calibration, diagnosis } from "../../api";
import { dateTime, duration, fixed, signed } from "../../format";
import { station } from "../../live";
import { Application } from "./application";
import { BeforeAfter } from "../../parts/before-after";
import { Causes, Hints } from "../diagnosis/causes";
import { FindCause } from "./find-cause";
import { Link } from "../../parts/link";
import { useLoaded } from "../../parts/load";
import { Memory } from "./memory";
import { SeparatingOffer } from "../diagnosis/separating";
import { ResidualChart } from "./residual-chart";
import { VerdictLine } from "../../parts/verdict";

/** Coverage factor of every expanded uncertainty on this page. */
const K = 2;

/** One run: `id` from the address, else the last one that ended or whose offsets were written. */
export function ResultView({ id }: { id: number | null }) {
  const last = station.value?.last;
  const shown = id ?? (last?.plan === "separating" ? last.id : (last?.of ?? last?.id)) ?? null;
  if (shown === null) return <Empty text={station.value ? "No run has ended yet." : "Waiting for the station …"} />;
  return <Result key={shown} id={shown} />;
}

function Empty({ text }: { text: string }) {
  return (
    <section class="panel">
      <h1>Result</h1>
      <p role="status">{text}</p>
    </section>
  );
}

function Result({ id }: { id: number }) {
  const run = station.value?.run;
  // asked again when the run that is shown, or one that writes its offsets, makes a step or ends
  const progress = run?.id === id || run?.of === id ? `running ${run.id} ${run.step}` : `ended ${station.value?.last?.id}`;
  const { value: result, trouble } = useLoaded(`${id} ${progress}`, () => calibration(id)).value;
  if (!result) return <Empty text={trouble ?? "Loading …"} />;
  const diagnosed = result.method === "diagnosis";
  const misfit = result.lack_of_fit !== null;
  const offer = result.of === null && result.ended_at && !diagnosed && <FindCause result={result} />;
  return (
    <div class="result">
      <section class="panel summary">
        <h1>
          Result of run {id}
          {result.of !== null && `: ${result.plan} of run ${result.of}`}
        </h1>
        <VerdictLine run={result} />
        <dl>
          <Fact name="Plan" value={result.plan} />
          <Fact name="Operator" value={result.operator} />
          {result.work_order && <Fact name="Work order" value={result.work_order} />}
          <Fact name="Started" value={dateTime(result.started_at ?? result.created_at)} />
          <Fact name="Took" value={took(result)} />
          {result.method && <Fact name="Method" value={result.method} />}
        </dl>
        <p class="actions">
          {result.of !== null && (
            <Link class="button" to={`/result/${result.of}`}>
              Result {result.of}
            </Link>
          )}
          <a class="button" href={`/api/v1/calibrations/${id}/readings.csv`} download>
            Readings (CSV)
          </a>
          {diagnosed && (
            <Link class="button" to={`/diagnosis/${id}`}>
              Diagnosis
            </Link>
          )}
          {diagnosed && (
            <a class="button" href={`/api/v1/calibrations/${id}/report.html`}>
              Report
            </a>
          )}
          <Link class="button" to={`/history?robot_serial=${encodeURIComponent(result.robot_serial)}`}>
            History of this robot
          </Link>
        </p>
      </section>
      {misfit && offer}
      {result.zero_offsets?.length ? (
        <>
          {diagnosed && <Found id={id} serial={result.robot_serial} />}
          <Application result={result} />
          <ZeroOffsets result={result} />
          <BeforeAfter result={result} />
          <WeakDirection result={result} />
          {result.of === null && !diagnosed && <Memory result={result} />}
          <Iterations result={result} />
          <ResidualChart id={id} residuals={result.residuals ?? []} />
        </>
      ) : (
        <section class="panel">
          <p>{result.ended_at ? "No zero offsets were identified in this run." : "The result follows the last reading."}</p>
        </section>
      )}
      {!misfit && offer}
    </div>
  );
}

/** What a diagnosis found, in short; its own page has the charts. */
function Found({ id, serial }: { id: number; serial: string }) {
  const { value: found, trouble } = useLoaded(`${id}`, () => diagnosis(id)).value;
  if (!found) {
    return (
      <section class="panel wide">
        <p role="status">{trouble ?? "Loading …"}</p>
      </section>
    );
  }
  return (
    <>
      <Causes found={found} />
      <SeparatingOffer id={id} serial={serial} found={found} />
      <Hints found={found} />
    </>
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
  if (!result.started_at || !result.ended_at) return "–";
  return duration((Date.parse(result.ended_at) - Date.parse(result.started_at)) / 1000);
}

function ZeroOffsets({ result }: { result: Calibration }) {
  const tolerance = result.zero_offset_tolerance_deg;
  return (
    <section class="panel">
      <h2>Zero offsets, in °</h2>
      <table>
        <thead>
          <tr>
            <th scope="col">Joint</th>
            <th scope="col">Value ± U</th>
            <th scope="col">sd</th>
            <th scope="col">Tolerance</th>
            <th scope="col" class="text">
              Verdict
            </th>
          </tr>
        </thead>
        <tbody>
          {result.zero_offsets?.map(({ joint, value_deg, sd_deg }) => (
            <tr>
              <th scope="row">{joint}</th>
              <td class="main">
                {signed(value_deg, 4)} ± {fixed(sd_deg === null ? null : K * sd_deg, 4)}
              </td>
              <td>{fixed(sd_deg, 4)}</td>
              <td>{tolerance === null ? "–" : `±${fixed(tolerance, 1)}`}</td>
              <td class="text">
                <Against value={value_deg} limit={tolerance} />
              </td>
            </tr>
          ))}
        </tbody>
      </table>
      <p class="note">U is the expanded uncertainty, k = {K}.</p>
      {result.parameters?.length ? (
        <p class="note">
          Also identified:{" "}
          {result.parameters
            .map(({ name, value, sd, unit }) => `${name} ${signed(value, 3)} ± ${fixed(sd && K * sd, 3)} ${unit}`)
            .join("; ")}
        </p>
      ) : null}
    </section>
  );
}

function Against({ value, limit }: { value: number | null; limit: number | null }) {
  if (value === null || limit === null) return <>–</>;
  return Math.abs(value) <= limit ? <>within</> : <strong class="alarm warn">◆ outside</strong>;
}

function WeakDirection({ result: { weak_direction: weak } }: { result: Calibration }) {
  if (!weak?.text) return null;
  return (
    <section class="panel">
      <h2>Weakest direction</h2>
      <p>
        {weak.text}
        {weak.sd_deg !== null && ` (sd ${fixed(weak.sd_deg, 3)}°)`}
      </p>
      {weak.remedy && <p class="note">What would help: {weak.remedy}</p>}
    </section>
  );
}

function Iterations({ result: { iterations } }: { result: Calibration }) {
  if (!iterations?.length) return null;
  return (
    <section class="panel">
      <h2>Passes, in °</h2>
      <table>
        <thead>
          <tr>
            <th scope="col">Pass</th>
            <th scope="col">Change 1</th>
            <th scope="col">Change 2</th>
            <th scope="col">Total 1</th>
            <th scope="col">Total 2</th>
            <th scope="col">μ</th>
          </tr>
        </thead>
        <tbody>
          {iterations.map((iteration) => (
            <tr>
              <th scope="row">{iteration.pass}</th>
              <td>{signed(iteration.dtheta1_deg, 4)}</td>
              <td>{signed(iteration.dtheta2_deg, 4)}</td>
              <td>{signed(iteration.total1_deg, 4)}</td>
              <td>{signed(iteration.total2_deg, 4)}</td>
              <td>{fixed(iteration.mu_deg, 4)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
}
