/** Every type that the page shares with the service; all come from the checked-in OpenAPI file. */
import type { components } from "./api-types";

type Schemas = components["schemas"];

export type Station = Schemas["StationView"];
export type StationWorkspace = Schemas["Workspace"];
export type Run = Schemas["RunView"];
export type RunReading = Schemas["RunReading"];
export type RunStop = Schemas["RunStop"];
export type Device = Schemas["DeviceView"];
export type DeviceState = Device["state"];
export type Interlock = Schemas["Interlock"];
export type Machine = Schemas["MachineView"];
export type State = Schemas["State"];
export type Verdict = NonNullable<Summary["verdict"]>;
export type Summary = Schemas["CalibrationSummary"];
export type Calibration = Schemas["Calibration"];
export type CalibrationBody = Schemas["CalibrationBody"];
export type CalibrationList = Schemas["CalibrationList"];
export type Plan = CalibrationBody["plan"];
export type ApplicationState = Schemas["Application"]["state"];
export type Quantity = Schemas["Quantity"];
export type Residual = Schemas["Residual"];
export type ResidualList = Schemas["ResidualList"];
export type ResidualRow = Schemas["ResidualRow"];
export type Separating = Schemas["Separating"];
export type Robot = Schemas["Robot"];
export type Stopped = Schemas["Stopped"];
export type Problem = Schemas["Problem"];

/** One message of the live feed, by its type. */
export type LiveMessage = Schemas["LiveMessage"];
export type LiveEvent = LiveMessage extends infer M
  ? M extends LiveMessage
    ? Pick<M, "type" | "data">
    : never
  : never;

export type RunKind = "calibrate" | "diagnose" | "separate" | "apply" | "rollback" | "import" | "retract";
export type Outcome = NonNullable<Summary["outcome"]>;

/** An effect of the catalogue, or an unnamed error, and where it acts. */
export type EffectAt = Pick<Schemas["EffectName"], "effect" | "joint"> & {
  part?: string | null;
  label?: string;
  depends_on?: string | null;
};

type First = Schemas["DiagnosisDocument"];
export type DiagnosisVerdict = First["verdict"] | "ambiguous";
export type Finding = Omit<First["findings"][number], "alias_set"> & {
  part?: string | null;
  probability?: number | null;
  alias_set: EffectAt[];
};

/** An error of an explanation, with its size. */
export type Held = EffectAt & { parameters?: Quantity[] };

export interface Explanation {
  /** None: the base model alone. */
  effects: Held[];
  probability: number;
  named: boolean;
}

export interface Experiment {
  kind: string;
  text: string;
  /** Probability that it will settle the question. */
  decides: number;
}

/** Where only a label of the file is wrong: what, and in which rows. */
export interface Mistake {
  kind: string;
  text: string;
  rows: number[];
}

/** What documents of schema 2 add to those of schema 1. */
interface Second {
  explanations?: Explanation[];
  experiments?: Experiment[];
  mistake?: Mistake | null;
}

export type Diagnosis = Omit<First, "schema" | "verdict" | "findings"> &
  Second & {
    schema: "station.diagnosis/1" | "station.diagnosis/2";
    verdict: DiagnosisVerdict;
    findings: Finding[];
  };

/** Of the position over the workspace, mm. */
export type PositionError = Schemas["PositionError"] & { bound_95?: number | null };
