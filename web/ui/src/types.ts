/** Every type that the page shares with the service.  All but one come from the checked-in OpenAPI file. */
import type { components } from "./api-types";

type Schemas = components["schemas"];

export type Station = Schemas["Station"];
export type StationWorkspace = Schemas["Workspace"];
export type Run = Schemas["Run"];
export type RunReading = Schemas["RunReading"];
export type RunStop = Schemas["RunStop"];
export type Device = Schemas["Device"];
export type DeviceState = Device["state"];
export type Interlock = Schemas["Interlock"];
export type Machine = Schemas["Machine"];
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
export type LiveEvent =
  | { type: "snapshot"; data: Station }
  | { type: "beat"; data: null }
  | { type: "run"; data: Omit<Run, "stops" | "readings"> }
  | { type: "walk"; data: { number: number; title: string; stops: RunStop[] } }
  | { type: "reading"; data: RunReading }
  | { type: "residuals"; data: Pick<RunReading, "reading" | "residual_mm" | "limit_mm">[] }
  | { type: "machine"; data: Machine | null }
  | { type: "device"; data: Device }
  | { type: "interlock"; data: Interlock[] }
  | { type: "ended"; data: Summary };
export type LiveMessage = LiveEvent & { number: number; at: string; build: string };

/** An effect of the catalogue, and the joint it belongs to. */
export interface EffectAt {
  effect: string;
  joint: number | null;
}

/** What the page shows of the document `station.diagnosis/1`, which OpenAPI does not describe yet. */
export interface Diagnosis {
  verdict: "adequate" | "explained" | "partly_explained" | "unexplained";
  confirmed: boolean | null;
  sentence: string;
  noise: { sigma_mm: number; source: "repeats" | "specification"; dof: number };
  outliers: number[];
  findings: (EffectAt & {
    parameters: { name: string; value: number; sd: number; unit: string }[];
    share: number;
    alias_set: EffectAt[];
    remedy: string;
    separating_experiment: string | null;
  })[];
  stages: {
    model: string;
    unknowns: number;
    fit_rms_mm: number;
    holdout_rms_mm: number | null;
    confirm_rms_mm: number | null;
    confirm_max_mm: number | null;
  }[];
  hints: { text: string; strength: number }[];
  invisible: {
    label: string;
    parameter: string | null;
    minimum_detectable: number | null;
    unit: string | null;
    text: string;
  }[];
}
