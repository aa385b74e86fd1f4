import { describe, expect, it } from "vitest";
import { t } from "../../../src/messages";
import type { ApplicationState, Calibration, Experiment, Outcome, State } from "../../../src/types";
import { nextStep, type Step } from "../../../src/views/result/steps";
import { calibration } from "../../samples";

type Drives = NonNullable<Calibration["application"]>;

const drives = (given: Partial<Drives> = {}): Drives => ({
  state: "unwritten",
  verified: false,
  text: "",
  joints: [],
  runs: [],
  apply_refused: null,
  rollback_refused: "There is nothing to roll back.",
  ...given,
});
const told = ({ why, act }: Step) => [why, act && (act.do === "start" ? act.plan : act.do)];
const stepAfter = (given: Partial<Calibration>, experiments: Experiment[] = []) =>
  told(nextStep(calibration({ plan: "full", ...given }), experiments));

describe("the next step after a gauge study", () => {
  const study = { kind: "gauge_study", plan: "gauge_study", verdict: null } as const;

  it("is its report, or to go on where it was interrupted", () => {
    expect(stepAfter({ ...study, outcome: "good" })).toEqual(["gauge", null]);
    expect(stepAfter({ ...study, state: "aborted", outcome: "aborted" })).toEqual(["resume", "resume"]);
    expect(stepAfter({ ...study, of: 3, state: "interrupted", outcome: "interrupted" })).toEqual([
      "resume",
      "resume",
    ]);
  });
});

describe("the next step after a calibration", () => {
  it.each([
    ["unwritten", {}, ["apply", "apply"]],
    ["unwritten", { apply_refused: "Locked." }, ["not_applicable", null]],
    ["applied", { verified: true }, ["applied", null]],
    ["applied", { rollback_refused: null }, ["roll_back", "roll_back"]],
    ["in doubt", { rollback_refused: null }, ["roll_back", "roll_back"]],
    ["partly", { rollback_refused: null }, ["roll_back", "roll_back"]],
    ["in doubt", {}, ["recalibrate", "full"]],
    ["rolled back", {}, ["recalibrate", "full"]],
    ["superseded", {}, ["recalibrate", "full"]],
  ] as [ApplicationState, Partial<Drives>, unknown][])("that is good, drives %s %o", (state, given, step) =>
    expect(stepAfter({ application: drives({ state, ...given }) })).toEqual(step),
  );

  const failed = (outcome: Outcome, more: Partial<Calibration> = {}) =>
    stepAfter({ verdict: "fail", outcome, ...more });

  it("looks for what the model lacks", () => {
    expect(failed("unexplained")).toEqual(["find_cause", "diagnostic"]);
    expect(failed("failed", { reason_code: "not_identified" })).toEqual(["find_cause", "diagnostic"]);
  });

  it("measures again where readings, a reference or the passes were wrong", () => {
    expect(failed("unexplained", { reason_code: "readout_jumped" })).toEqual(["again", "full"]);
    expect(failed("unexplained", { reason_code: "reference_contradicted" })).toEqual(["again", "full"]);
    expect(failed("not_verified", { plan: "rapid" })).toEqual(["again", "rapid"]);
  });

  const advice = (kind: string, joint: number | null = null) => [
    { kind, text: "Measure.", joint, gain_mm: 0.2, minutes: 3 },
  ];

  it("raises the accuracy by the best advice, in mm and minutes", () => {
    expect(failed("not_accurate_enough")).toEqual(["no_advice", null]);
    expect(failed("not_accurate_enough", { advice: advice("repeat") })).toEqual(["raise", "full"]);
    expect(failed("not_accurate_enough", { advice: advice("joint_angle", 1) })).toEqual([
      "raise",
      "reference",
    ]);
    expect(failed("not_accurate_enough", { advice: advice("joint_angle", 2) })).toEqual([
      "raise_by_hand",
      "open",
    ]);
    expect(failed("not_accurate_enough", { advice: advice("second_mount") })).toEqual([
      "raise",
      "two_mounts",
    ]);
    const { more } = nextStep(
      calibration({ verdict: "fail", outcome: "not_accurate_enough", advice: advice("drm_x") }),
    );
    expect(more).toContain("0.200 mm");
    expect(more).toContain("3 min 00 s");
  });

  it("prefers the first advice that is sufficient on its own", () => {
    const cheap = { kind: "repeat", text: "Measure.", joint: null, gain_mm: 0.1, minutes: 0.04 };
    const both = [cheap, ...advice("joint_angle", 1)];
    const wanting = (wanted_mm: number) => ({
      accuracy: { ...calibration().accuracy!, bound_95_mm: 0.4, wanted_mm, reached: false },
      advice: both,
    });
    expect(failed("not_accurate_enough", wanting(0.25))).toEqual(["raise", "reference"]);
    expect(failed("not_accurate_enough", wanting(0.35))).toEqual(["raise", "full"]);
    expect(failed("not_accurate_enough", wanting(0.1))).toEqual(["raise", "full"]);
  });

  it("is never an application where the bound does not keep the limit", () => {
    const accuracy = {
      bound_95_mm: 0.6,
      bound_95_model_mm: 0.5,
      wanted_mm: 0.5,
      reached: false,
      stopped_because: null,
      stopped_because_said: null,
    };
    expect(stepAfter({ accuracy, application: drives() })).toEqual(["no_advice", null]);
    expect(stepAfter({ accuracy: { ...accuracy, bound_95_mm: null }, application: drives() })[0]).toBe(
      "no_advice",
    );
  });
});

describe("the next step after a diagnosis", () => {
  const experiment = (kind: string, decides: number) =>
    ({ kind, text: `By ${kind}.`, decides }) as unknown as Experiment;
  const diagnosis = (outcome: Outcome, experiments: Experiment[] = [], more: Partial<Calibration> = {}) =>
    stepAfter(
      {
        kind: "diagnose",
        plan: "diagnostic",
        verdict: outcome === "good" ? "pass" : "fail",
        outcome,
        ...more,
      },
      experiments,
    );

  it("is a repair, and the run after it", () => expect(diagnosis("repair")).toEqual(["repaired", "full"]));
  it("is a calibration where nothing is missing", () =>
    expect(diagnosis("good")).toEqual(["calibrate", "full"]));
  const ambiguous = calibration({ kind: "diagnose", verdict: "fail", outcome: "ambiguous" });
  it("is the experiment that is most probable to decide", () => {
    const both = [experiment("payload", 0.3), experiment("motion", 0.9)];
    expect(diagnosis("ambiguous", both)).toEqual(["decide", "separate"]);
    expect(diagnosis("ambiguous", [experiment("payload", 0.95), ...both])).toEqual([
      "decide_by_hand",
      "open",
    ]);
    // a run that went on from another cannot be continued once more
    expect(diagnosis("ambiguous", both, { kind: "separate", plan: "separating", of: 3 })).toEqual([
      "decide_by_hand",
      "open",
    ]);
    expect(diagnosis("ambiguous", [experiment("second_mount", 0.9)])).toEqual(["decide_by_plan", "prepare"]);
    expect(nextStep(ambiguous, [experiment("joint_reference", 0.9)]).act).toEqual({
      do: "prepare",
      plan: "reference",
    });
    expect(diagnosis("ambiguous")).toEqual(["see", "open"]);
  });
  it("is its details where the cause was not found, and for a file", () => {
    expect(diagnosis("unexplained")).toEqual(["see", "open"]);
    for (const outcome of ["good", "repair", "failed"] as const) {
      expect(diagnosis(outcome, [], { kind: "import", plan: "dataset" })).toEqual(["see", "open"]);
    }
  });
});

describe("the next step after what belongs to another run", () => {
  it.each([
    ["apply", "good", ["applied_there", "open"]],
    ["apply", "not_verified", ["recalibrate", "full"]],
    ["rollback", "good", ["back", "open"]],
  ] as const)("%s, %s", (kind, outcome, step) =>
    expect(
      stepAfter({ kind, plan: kind, of: 1, outcome, verdict: outcome === "good" ? "pass" : "fail" }),
    ).toEqual(step),
  );
  it("is there, when it was ended", () =>
    expect(stepAfter({ kind: "apply", plan: "apply", of: 4, state: "aborted", verdict: null })).toEqual([
      "back",
      "open",
    ]));
  it("is a calibration after a retract, and after a check that found a shift", () => {
    expect(stepAfter({ kind: "retract", plan: "retract", verdict: null, outcome: null })).toEqual([
      "inside",
      "open",
    ]);
    expect(stepAfter({ kind: "check", plan: "check" })).toEqual(["produce", null]);
    expect(stepAfter({ kind: "check", plan: "check", verdict: "fail", outcome: "repair" })).toEqual([
      "shifted",
      "adaptive",
    ]);
    const check = { known_by: 7 } as Calibration["check"];
    const { act } = nextStep(
      calibration({ kind: "check", plan: "check", verdict: "fail", outcome: "repair", check }),
    );
    expect(act).toEqual({ do: "open", to: "/result/7" });
  });
});

describe("every state and outcome of every kind of run", () => {
  const states = Object.keys(t.states) as State[];
  const outcomes = [...(Object.keys(t.outcomes) as Outcome[]), null];
  const kinds = Object.keys(t.runKinds) as Calibration["kind"][];
  const all = states.flatMap((state) =>
    kinds.flatMap((kind) =>
      outcomes.flatMap((outcome) =>
        (["pass", "fail", null] as const).map((verdict) =>
          calibration({ state, kind, outcome, verdict, plan: "full", application: drives() }),
        ),
      ),
    ),
  );

  it("has one step with a text, and a button where there is something to do", () => {
    for (const run of all) {
      const { why, act } = nextStep(run);
      const entry: { text: string; button?: string } = t.result.next[why];
      expect([entry.text !== "", entry.button !== undefined]).toEqual([true, act !== null]);
    }
  });

  it("writes to the drives only after a good calibration", () => {
    const writes = all.filter((run) => nextStep(run).act?.do === "apply");
    expect(writes.length).toBeGreaterThan(0);
    for (const { state, kind, outcome, verdict } of writes) {
      expect([state, kind, outcome, verdict]).toEqual(["succeeded", "calibrate", "good", "pass"]);
    }
  });
});
