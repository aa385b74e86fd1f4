/** One run: its decision, the next step, the position errors; the engineer's tables folded below. */
import { calibration, diagnosis } from "../../api";
import { station } from "../../live";
import { t } from "../../messages";
import { BeforeAfter } from "../../parts/before-after";
import { Fold } from "../../parts/fold";
import { useLoaded } from "../../parts/load";
import type { Calibration } from "../../types";
import { Accuracy } from "./accuracy";
import { Application } from "./application";
import { ErrorMaps, hasMap } from "./error-maps";
import { FindCause } from "./find-cause";
import { FoundCauses } from "./found-causes";
import { Iterations } from "./iterations";
import { Memory } from "./memory";
import { NextStep } from "./next-step";
import { ResidualChart } from "./residual-chart";
import { ResultSummary, RunFacts, Ways } from "./result-summary";
import { Translate } from "./translate";
import { WeakDirection } from "./weak-direction";
import { ZeroOffsets } from "./zero-offsets";

/** `id` from the address, otherwise the last run that ended or whose offsets were written. */
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
  // requested again when the displayed run, or one that writes its offsets, makes a step or ends
  const progress =
    run?.id === id || run?.of === id ? `running ${run.id} ${run.step}` : `ended ${station.value?.last?.id}`;
  const { value: result, trouble } = useLoaded(`${id} ${progress}`, () => calibration(id)).value;
  if (!result) return <Empty text={trouble ?? t.shared.loading} />;
  return result.method === "diagnosis" ? <Diagnosed result={result} /> : <Shown result={result} />;
}

/** With the findings of the diagnosis; the head is shown before. */
function Diagnosed({ result }: { result: Calibration }) {
  const { value: found, trouble } = useLoaded(`${result.id}`, () => diagnosis(result.id)).value;
  return (
    <Shown result={result} experiments={found?.experiments ?? []}>
      <Fold name="causes" title={t.diagnosis.causes}>
        <FoundCauses id={result.id} serial={result.robot_serial} found={found} trouble={trouble} />
      </Fold>
    </Shown>
  );
}

interface ShownProps {
  result: Calibration;
  experiments?: Parameters<typeof NextStep>[0]["experiments"];
  children?: preact.ComponentChildren;
}

function Shown({ result, experiments, children }: ShownProps) {
  const { id, of, method, residuals } = result;
  const identified = result.zero_offsets.length > 0;
  return (
    <div class="result">
      <ResultSummary result={result} />
      <NextStep result={result} experiments={experiments} />
      {hasMap(result) && <ErrorMaps result={result} />}
      {!identified && !result.ended_at && <p class="panel wide">{t.result.pending}</p>}
      {children}
      {identified && (
        <Fold name="offsets" title={t.result.offsets}>
          <ZeroOffsets result={result} />
          <WeakDirection result={result} />
          <Iterations result={result} />
        </Fold>
      )}
      {(result.accuracy ?? result.check ?? result.after) && (
        <Fold name="accuracy" title={t.result.promised}>
          <Accuracy result={result} />
          {identified && <BeforeAfter result={result} />}
        </Fold>
      )}
      {result.application && (
        <Fold name="drives" title={t.result.drives}>
          <Application result={result} />
        </Fold>
      )}
      {result.application?.state === "applied" && (
        <Fold name="taught" title={t.result.translate.title}>
          <Translate id={id} />
        </Fold>
      )}
      {residuals.length > 0 && (
        <Fold name="residuals" title={t.result.residuals}>
          <ResidualChart id={id} residuals={residuals} />
        </Fold>
      )}
      {of === null && identified && method !== "diagnosis" && (
        <Fold name="memory" title={t.result.memory(result.robot_serial)}>
          <Memory result={result} />
        </Fold>
      )}
      {of === null && result.ended_at && method !== "diagnosis" && (
        <Fold name="cause" title={t.result.checkModel}>
          <FindCause result={result} />
        </Fold>
      )}
      <Fold name="run" title={t.result.run}>
        <RunFacts result={result} />
      </Fold>
      <Ways result={result} />
    </div>
  );
}
