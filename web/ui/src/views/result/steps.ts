/** The recommended next step, from the result of a run. */
import { duration, fixed } from "../../format";
import { t } from "../../messages";
import { adviceText, readable } from "../../names";
import { told } from "../../phrase";
import type { Calibration, Experiment, Plan } from "../../types";
import { decisionOf } from "./decision";

export type Act =
  | { do: "start"; plan: Plan }
  | { do: "apply" }
  | { do: "roll_back" }
  | { do: "separate" }
  | { do: "resume" }
  | { do: "prepare"; plan: Plan }
  | { do: "open"; to: string };

export interface Step {
  why: keyof typeof t.result.next;
  /** Null if there is nothing to do. */
  act: Act | null;
  /** In addition to the text of every step of this kind. */
  more: string;
}

const THOROUGH: Plan = "full";
const DIAGNOSTIC: Plan = "diagnostic";
/** Only the zeros have shifted: geometry and mechanism are known. */
const QUICK: Plan = "adaptive";
const SECONDS = 60;
/** Experiments that the station guides. */
const PLAN_OF_EXPERIMENT: Record<string, Plan> = { second_mount: "two_mounts", joint_reference: "reference" };
const PLANS = new Set(Object.keys(t.plans));

/** The plan that implements an advice; null if a person has to measure first. */
function planOf({ kind, joint }: Calibration["advice"][number], plan: string): Plan | null {
  if (kind === "repeat" && PLANS.has(plan)) return plan as Plan;
  if (kind === "second_mount") return "two_mounts";
  // the plan asks for the angle of joint 1
  return kind === "joint_angle" && joint === 1 ? "reference" : null;
}

const open = (why: Step["why"], to: string, more = ""): Step => ({ why, act: { do: "open", to }, more });
const start = (why: Step["why"], plan: Plan, more = ""): Step => ({ why, act: { do: "start", plan }, more });
const nothing = (why: Step["why"], more = ""): Step => ({ why, act: null, more });

/** @param experiments of the diagnosis, if there is one */
export function nextStep(result: Calibration, experiments: readonly Experiment[] = []): Step {
  switch (result.state) {
    case "queued":
    case "running":
      return open("watch", "/");
    case "waiting":
      return open("answer", "/");
    case "succeeded":
      break;
    default:
      return again(result);
  }
  if (result.verdict === null && result.outcome === null) {
    return result.kind === "retract" ? open("inside", "/") : again(result);
  }
  switch (result.kind) {
    case "apply":
    case "rollback":
      return afterWriting(result);
    case "retract":
      return open("inside", "/");
    case "gauge_study":
      return nothing("gauge");
    case "check":
      return afterCheck(result);
    case "calibrate":
      return afterCalibration(result);
    default:
      return afterDiagnosis(result, experiments);
  }
}

/** The same request again; data of another run are entered there. */
function again({ id, of, kind, plan }: Calibration): Step {
  if (kind === "gauge_study") return { why: "resume", act: { do: "resume" }, more: "" };
  if (kind === "retract") return open("again_there", "/");
  if (of !== null) return open("back", `/result/${of}`);
  return PLANS.has(plan) ? start("again", plan as Plan) : nothing("look", `${id}`);
}

function afterWriting({ of, outcome, kind }: Calibration): Step {
  if (outcome === "good" && of !== null)
    return open(kind === "apply" ? "applied_there" : "back", `/result/${of}`);
  return start("recalibrate", THOROUGH);
}

function afterCheck(result: Calibration): Step {
  if (decisionOf(result).look.good) return nothing("produce");
  if (result.check?.known_by != null) return open("apply_known", `/result/${result.check.known_by}`);
  return result.outcome === "repair" ? start("shifted", QUICK) : start("find_cause", DIAGNOSTIC);
}

function afterCalibration(result: Calibration): Step {
  if (decisionOf(result).look.good) return afterPass(result);
  switch (result.reason_code) {
    case "readout_too_coarse":
      return start("too_coarse", THOROUGH);
    case "readout_jumped":
    case "joint_slipped":
    case "something_jumped":
    case "reference_contradicted":
    case "mu_too_large":
    case "offset_impossible":
      return again(result);
  }
  if (result.outcome === "not_verified") return again(result);
  if (result.outcome === "not_accurate_enough" || result.outcome === "good") return raise(result);
  return start("find_cause", DIAGNOSTIC);
}

function afterPass({ application }: Calibration): Step {
  if (!application) return nothing("produce");
  switch (application.state) {
    case "unwritten":
      return application.apply_refused === null
        ? { why: "apply", act: { do: "apply" }, more: "" }
        : nothing("not_applicable", readable(application.apply_refused));
    case "applied":
      if (application.verified) return nothing("applied");
  }
  if (application.state === "rolled back" || application.state === "superseded") {
    return start("recalibrate", THOROUGH);
  }
  return application.rollback_refused === null
    ? { why: "roll_back", act: { do: "roll_back" }, more: "" }
    : start("recalibrate", THOROUGH, readable(application.rollback_refused));
}

/** The first advice that is sufficient on its own; otherwise the one with the largest gain per minute. */
function raise(result: Calibration): Step {
  const { bound_95_mm: bound, wanted_mm: wanted } = result.accuracy ?? {};
  const lacking = bound == null || wanted == null ? 0 : bound - wanted;
  const best = result.advice.find(({ gain_mm }) => gain_mm >= lacking) ?? result.advice[0];
  if (!best) return nothing("no_advice");
  const more = t.result.advised(adviceText(best), fixed(best.gain_mm, 3), duration(SECONDS * best.minutes));
  const plan = planOf(best, result.plan);
  return plan ? start("raise", plan, more) : open("raise_by_hand", "/", more);
}

function afterDiagnosis(result: Calibration, experiments: readonly Experiment[]): Step {
  const measured = result.kind !== "import";
  const details = `/diagnosis/${result.id}`;
  switch (result.outcome) {
    case "repair":
      return measured ? start("repaired", THOROUGH) : open("see", details);
    case "good":
    case "not_accurate_enough":
      return measured ? start("calibrate", THOROUGH) : open("see", details);
    case "ambiguous": {
      const [best] = experiments.toSorted((a, b) => b.decides - a.decides);
      if (!best) return open("see", details);
      if (best.kind === "motion" && result.kind === "diagnose") {
        return { why: "decide", act: { do: "separate" }, more: told(best) };
      }
      const plan = Object.hasOwn(PLAN_OF_EXPERIMENT, best.kind) ? PLAN_OF_EXPERIMENT[best.kind] : undefined;
      return plan && measured
        ? { why: "decide_by_plan", act: { do: "prepare", plan }, more: told(best) }
        : open("decide_by_hand", details, told(best));
    }
    case "not_verified":
    case "failed":
      return measured ? again(result) : open("see", details);
    default:
      return open("see", details);
  }
}
