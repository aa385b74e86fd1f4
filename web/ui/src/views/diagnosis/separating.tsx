/** Where a cause has look-alikes: the motion that tells them apart, planned and run from here, or that none does. */
import { type Diagnosis, newKey, separate, separating, type Separating } from "../../api";
import { duration, fixed } from "../../format";
import { connected, station } from "../../live";
import { keepOperator, operator } from "../../operator";
import { navigate } from "../../router";
import { ConfirmedButton } from "../../parts/confirm";
import { useLoaded } from "../../parts/load";
import { OperatorField } from "../../parts/operator-field";

const FRESH = 40;

export function SeparatingOffer({ id, serial, found }: { id: number; serial: string; found: Diagnosis }) {
  const aliased = found.findings.some(({ alias_set }) => alias_set.length > 1);
  return aliased ? <Offer id={id} serial={serial} /> : null;
}

function Offer({ id, serial }: { id: number; serial: string }) {
  // asked again when a run ends: it may have changed the machine
  const { value: plan, trouble } = useLoaded(`${id} ${station.value?.last?.id}`, () => separating(id)).value;
  const idle = connected.value && !station.value?.run && operator.value.trim() !== "";
  const run = async () => {
    keepOperator();
    const started = await separate(id, operator.value.trim(), newKey());
    navigate(`/result/${started.id}`);
  };
  if (!plan || plan.refused) {
    return (
      <section class="panel wide" aria-label="Look-alikes">
        <h2>Telling the look-alikes apart</h2>
        <p role="status">{plan?.refused ?? trouble ?? "Planning …"}</p>
      </section>
    );
  }
  return (
    <section class="panel wide find-cause" aria-label="Look-alikes">
      <h2>Telling the look-alikes apart</h2>
      <div class="separating">
        <div>
          <p>
            {plan.stops.length} more readings at the places where the models differ most should decide on{" "}
            <strong>{plan.apart.join(", ").replaceAll("_", " ")}</strong>; {FRESH} fresh readings then judge anew. About{" "}
            {duration(plan.duration_s)}.
          </p>
          <p class="note">It goes on from this run: leave scale, drives and mechanism as they are.</p>
        </div>
        <Places stops={plan.stops} />
      </div>
      <div class="writes">
        <OperatorField id="separating-operator" />
        <ConfirmedButton label="Run the separating experiment" disabled={!idle} act={run}>
          <strong>Robot {serial} will move</strong> over its workspace. Nobody within its reach?
        </ConfirmedButton>
      </div>
    </section>
  );
}

/** The planned places; a circle is larger the more often it is read. */
function Places({ stops }: { stops: Separating["stops"] }) {
  const workspace = station.value?.workspace;
  if (!workspace) return null;
  const [left, right] = workspace.x;
  const [bottom, top] = workspace.y;
  const often = new Map<string, { x: number; y: number; times: number }>();
  for (const { position, x_mm, y_mm } of stops) {
    const times = (often.get(position)?.times ?? 0) + 1;
    often.set(position, { x: x_mm, y: y_mm, times });
  }
  return (
    <svg
      class="map"
      role="img"
      aria-label={`${often.size} planned places, x from ${fixed(left, 0)} to ${fixed(right, 0)} mm, y from ${fixed(bottom, 0)} to ${fixed(top, 0)} mm`}
      viewBox={`${left - 20} ${-top - 20} ${right - left + 40} ${top - bottom + 40}`}
    >
      <rect class="area" x={left} y={-top} width={right - left} height={top - bottom} />
      {[...often].map(([position, { x, y, times }]) => (
        <circle key={position} cx={x} cy={-y} r={3 + 2 * Math.sqrt(times)} />
      ))}
    </svg>
  );
}
