/** Which stored parameters of geometry and mechanism the next run starts from, and whether this one used them. */
import { useSignal } from "@preact/signals";
import { forget, robot } from "../../api";
import { fixed } from "../../format";
import { connected, station } from "../../live";
import { t } from "../../messages";
import { operator } from "../../operator";
import { ConfirmedButton } from "../../parts/confirm";
import { Link } from "../../parts/link";
import { useLoaded } from "../../parts/load";
import { toldInside } from "../../phrase";
import type { Calibration, Robot } from "../../types";

export function Memory({ result: { memory, fleet, robot_serial } }: { result: Calibration }) {
  const forgotten = useSignal(0);
  // requested again when a run ends: it may have left new ones
  const key = `${robot_serial} ${station.value?.last?.id} ${forgotten.value}`;
  const { value } = useLoaded(key, () => robot(robot_serial)).value;
  const next = value?.memory ?? null;
  const drop = async () => {
    await forget(robot_serial, operator.value.trim() || "page");
    forgotten.value += 1;
  };
  return (
    <div class="memory">
      <p class="used">
        {memory ? <Used memory={memory} /> : fleet ? <Taught fleet={fleet} /> : t.result.memoryNone}
      </p>
      <p>{value && <Next next={next} />}</p>
      <ConfirmedButton label={t.result.forget} disabled={!connected.value || !next} act={drop}>
        {t.result.forgetWarning(robot_serial)}
        <strong>{t.result.forgetEmphasis}</strong>
        {t.result.forgetAs}
      </ConfirmedButton>
    </div>
  );
}

function Next({ next }: { next: Robot["memory"] }) {
  if (!next) return t.result.memoryNextNone;
  return t.result.memoryNext(next.from_calibration, fixed(next.age_days, 1));
}

function Taught({ fleet }: { fleet: NonNullable<Calibration["fleet"]> }) {
  const { serials, type } = fleet.prior;
  const p = fixed(fleet.p_value, 3);
  if (fleet.used) return t.result.fleetUsed(serials.length, type, serials.join(", "), p);
  return <strong class="alarm warn">{t.result.fleetNotUsed(type, serials.join(", "), p)}</strong>;
}

function Used({ memory }: { memory: NonNullable<Calibration["memory"]> }) {
  return (
    <>
      {memory.used ? t.result.memoryUsed : <strong class="alarm warn">{t.result.memoryNotUsed}</strong>}
      {t.result.memoryText(toldInside(memory))}
      <Link class="cell" to={`/result/${memory.from_calibration}`}>
        {t.shared.run(memory.from_calibration)}
      </Link>
      {t.result.memoryAge(fixed(memory.age_days, 1), fixed(memory.p_value, 3))}
    </>
  );
}
