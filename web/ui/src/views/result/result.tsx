/** One run: verdict, zero offsets, drives, accuracy, and where to look for a missing effect. */
import { calibration } from "../../api";
import { station } from "../../live";
import { t } from "../../messages";
import { BeforeAfter } from "../../parts/before-after";
import { useLoaded } from "../../parts/load";
import type { Calibration } from "../../types";
import { Accuracy } from "./accuracy";
import { Application } from "./application";
import { FindCause } from "./find-cause";
import { FoundCauses } from "./found-causes";
import { Iterations } from "./iterations";
import { Memory } from "./memory";
import { ResidualChart } from "./residual-chart";
import { ResultSummary } from "./result-summary";
import { WeakDirection } from "./weak-direction";
import { ZeroOffsets } from "./zero-offsets";

/** `id` from the address, else the last run that ended or whose offsets were written. */
export function ResultView({ id }: { id: number | null }) {
  const last = station.value?.last;
  const shown = id ?? (last?.kind === "separate" ? last.id : (last?.of ?? last?.id)) ?? null;
  if (shown === null) return <Empty text={station.value ? t.result.none : t.result.waiting} />;
  return <Result key={shown} id={shown} />;
}

function Empty({ text }: { text: string }) {
  return (
    <section class="panel">
      <h1>{t.result.title}</h1>
      <p role="status">{text}</p>
    </section>
  );
}

function Result({ id }: { id: number }) {
  const run = station.value?.run;
  // asked again when the run that is shown, or one that writes its offsets, makes a step or ends
  const progress =
    run?.id === id || run?.of === id ? `running ${run.id} ${run.step}` : `ended ${station.value?.last?.id}`;
  const { value: result, trouble } = useLoaded(`${id} ${progress}`, () => calibration(id)).value;
  if (!result) return <Empty text={trouble ?? t.shared.loading} />;
  const misfit = result.lack_of_fit !== null;
  const offer = result.of === null && result.ended_at && result.method !== "diagnosis" && (
    <FindCause result={result} />
  );
  return (
    <div class="result">
      <ResultSummary result={result} />
      {misfit && offer}
      {result.zero_offsets.length ? (
        <Identified result={result} />
      ) : (
        <>
          <Accuracy result={result} />
          <section class="panel">
            <p>{result.ended_at ? t.result.noOffsets : t.result.pending}</p>
          </section>
        </>
      )}
      {!misfit && offer}
    </div>
  );
}

/** Everything that follows from identified zero offsets. */
function Identified({ result }: { result: Calibration }) {
  const diagnosed = result.method === "diagnosis";
  return (
    <>
      {diagnosed && <FoundCauses id={result.id} serial={result.robot_serial} />}
      <Accuracy result={result} />
      <Application result={result} />
      <ZeroOffsets result={result} />
      <BeforeAfter result={result} />
      <WeakDirection result={result} />
      {result.of === null && !diagnosed && <Memory result={result} />}
      <Iterations result={result} />
      <ResidualChart id={result.id} residuals={result.residuals} />
    </>
  );
}
