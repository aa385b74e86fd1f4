import { plan as readPlan } from "../../api";
import { duration, fixed } from "../../format";
import { t } from "../../messages";
import { useLoaded } from "../../parts/load";
import { plan, serial } from "./start";

/** How long the chosen plan takes and how good it gets, for a robot within its tolerances. */
export function PlanPromise() {
  const key = `${plan.value} ${serial.value.trim()}`;
  const { value } = useLoaded(key, () => readPlan(plan.value, serial.value.trim())).value;
  const predicted = value?.predicted;
  if (!predicted || predicted.duration_s === null) return null;
  return (
    <p id="plan-promise" class="note">
      {t.station.promise(value.stops.length, duration(predicted.duration_s), fixed(predicted.bound_95_mm, 2))}
    </p>
  );
}
