/** For a cause with alternative explanations: the motion that distinguishes them, started from here. */
import { newKey, separate, separating } from "../../api";
import { duration, fixed } from "../../format";
import { connected, station } from "../../live";
import { t } from "../../messages";
import { labelsInSentence, readable } from "../../names";
import { keepOperator, operator } from "../../operator";
import { ConfirmedButton } from "../../parts/confirm";
import { useLoaded } from "../../parts/load";
import { MotionWarning } from "../../parts/motion-warning";
import { OperatorField } from "../../parts/operator-field";
import { navigate } from "../../router";
import type { Diagnosis, Separating } from "../../types";

const FRESH = 40;

export function SeparatingOffer({ id, serial, found }: { id: number; serial: string; found: Diagnosis }) {
  const aliased = found.findings.some(({ alias_set }) => alias_set.length > 1);
  return aliased ? <Offer id={id} serial={serial} /> : null;
}

function Offer({ id, serial }: { id: number; serial: string }) {
  // requested again when a run ends: it may have changed the machine
  const { value: plan, trouble } = useLoaded(`${id} ${station.value?.last?.id}`, () => separating(id)).value;
  const idle = connected.value && !station.value?.run && operator.value.trim() !== "";
  const run = async () => {
    keepOperator();
    const started = await separate(id, operator.value.trim(), newKey());
    navigate(`/result/${started.id}`);
  };
  if (!plan || plan.refused) {
    return (
      <section class="panel wide" aria-label={t.diagnosis.alternatives}>
        <h2>{t.diagnosis.distinguish}</h2>
        <p role="status">{(plan?.refused && readable(plan.refused)) ?? trouble ?? t.diagnosis.planning}</p>
      </section>
    );
  }
  return (
    <section class="panel wide find-cause" aria-label={t.diagnosis.alternatives}>
      <h2>{t.diagnosis.distinguish}</h2>
      <div class="separating">
        <div>
          <p>
            {t.diagnosis.moreReadings(plan.stops.length)}
            <strong>{t.listed(plan.apart.map(labelsInSentence))}</strong>
            {t.diagnosis.freshReadings(FRESH, duration(plan.duration_s))}
          </p>
          <p class="note">{t.diagnosis.continues}</p>
        </div>
        <PlannedPositions stops={plan.stops} />
      </div>
      <div class="writes">
        <OperatorField id="separating-operator" />
        <ConfirmedButton label={t.diagnosis.runSeparating} disabled={!idle} act={run}>
          <MotionWarning serial={serial} then={t.diagnosis.workspace} />
        </ConfirmedButton>
      </div>
    </section>
  );
}

/** The planned positions; a circle is larger if it is read more often. */
function PlannedPositions({ stops }: { stops: Separating["stops"] }) {
  const workspace = station.value?.workspace;
  if (!workspace) return null;
  const [left, right] = workspace.x;
  const [bottom, top] = workspace.y;
  const often = new Map<string, { x: number; y: number; times: number }>();
  for (const { position, x_mm, y_mm } of stops) {
    const times = (often.get(position)?.times ?? 0) + 1;
    often.set(position, { x: x_mm, y: y_mm, times });
  }
  const whole = (mm: number) => fixed(mm, 0);
  return (
    <svg
      class="map"
      role="img"
      aria-label={t.diagnosis.planned(often.size, whole(left), whole(right), whole(bottom), whole(top))}
      viewBox={`${left - 20} ${-top - 20} ${right - left + 40} ${top - bottom + 40}`}
    >
      <rect class="area" x={left} y={-top} width={right - left} height={top - bottom} />
      {[...often].map(([position, { x, y, times }]) => (
        <circle key={position} cx={x} cy={-y} r={3 + 2 * Math.sqrt(times)} />
      ))}
    </svg>
  );
}
