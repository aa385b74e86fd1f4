/** What a robot's next run will know of geometry and mechanism, and whether this one used it. */
import { useSignal } from "@preact/signals";
import { type Calibration, forget, robot } from "../../api";
import { fixed } from "../../format";
import { connected, station } from "../../live";
import { operator } from "../../operator";
import { ConfirmedButton } from "../../parts/confirm";
import { Link } from "../../parts/link";
import { useLoaded } from "../../parts/load";

export function Memory({ result: { memory, robot_serial } }: { result: Calibration }) {
  const forgotten = useSignal(0);
  // asked again when a run ends: it may have left something new
  const key = `${robot_serial} ${station.value?.last?.id} ${forgotten.value}`;
  const { value } = useLoaded(key, () => robot(robot_serial)).value;
  const next = value?.memory ?? null;
  const drop = async () => {
    await forget(robot_serial, operator.value.trim() || "page");
    forgotten.value += 1;
  };
  return (
    <section class="panel memory">
      <h2>Memory of robot {robot_serial}</h2>
      <p class="used">
        {memory ? (
          <>
            {memory.used ? "Used" : <strong class="alarm warn">◆ Not used</strong>}: {memory.text},{" "}
            <Link class="cell" to={`/result/${memory.from_calibration}`}>
              run {memory.from_calibration}
            </Link>
            , {fixed(memory.age_days, 1)} days before. p = {fixed(memory.p_value, 3)}.
          </>
        ) : (
          "This run used no memory."
        )}
      </p>
      <p>
        {next
          ? `The next rapid or full run starts from run ${next.from_calibration}, ${fixed(next.age_days, 1)} days old.`
          : "The next run starts without memory."}
      </p>
      <ConfirmedButton label="Forget" disabled={!connected.value || !next} act={drop}>
        The next run of robot {robot_serial} will start <strong>without memory</strong>, as after the mechanism was
        mounted anew.
      </ConfirmedButton>
    </section>
  );
}
