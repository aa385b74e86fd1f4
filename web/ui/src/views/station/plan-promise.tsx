import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { plan as readPlan } from "../../api";
import { duration, fixed } from "../../format";
import { t } from "../../messages";
import { useLoaded } from "../../parts/load";
import { plan, serial } from "./start";

/** A plan is computed for each serial: only for a completely typed one. */
const TYPED_MS = 300;

/** Plans that identify no zero offsets, so nothing follows for the position error. */
const WITHOUT_ZEROS = new Set<string>(["check", "gauge_study"]);

/** Duration and predicted accuracy of the chosen plan, for a robot within its tolerances. */
export function PlanPromise() {
  const typed = serial.value.trim();
  const settled = useSignal(typed);
  useEffect(() => {
    const timer = setTimeout(() => {
      settled.value = typed;
    }, TYPED_MS);
    return () => clearTimeout(timer);
  }, [typed]);
  const { value } = useLoaded(`${plan.value} ${settled.value}`, () =>
    readPlan(plan.value, settled.value),
  ).value;
  const predicted = value?.predicted;
  if (!predicted || predicted.duration_s === null) return null;
  return (
    <p id="plan-promise" class="note">
      {t.station.effort(value.stops.length, duration(predicted.duration_s))}
      {!WITHOUT_ZEROS.has(plan.value) && t.station.promise(fixed(predicted.bound_95_mm, 2))}
    </p>
  );
}
