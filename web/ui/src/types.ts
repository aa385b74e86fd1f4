/** All types that the page shares with the service; they come from the checked-in OpenAPI file. */
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
export type SignedIn = Schemas["SignedIn"];
export type SignInWays = Schemas["SignInWays"];
export type Summary = Schemas["CalibrationSummary"];
export type Calibration = Schemas["Calibration"];
export type CalibrationBody = Schemas["CalibrationBody"];
export type CalibrationList = Schemas["CalibrationList"];
export type Plan = CalibrationBody["plan"];
export type PlanDocument = Schemas["PlanDocument"];
export type ApplicationState = Schemas["Application"]["state"];
export type Quantity = Schemas["Quantity"];
export type Residual = Schemas["Residual"];
export type ResidualList = Schemas["ResidualList"];
export type ResidualRow = Schemas["ResidualRow"];
export type ErrorMap = Schemas["ErrorMap"];
export type Target = Schemas["SolveBody"]["targets"][number];
export type Solution = Schemas["Solution"];
export type TaughtPosition = Schemas["TaughtPosition"];
export type TranslatedList = Schemas["TranslatedList"];
export type TranslatedPosition = Schemas["TranslatedPosition"];
export type Separating = Schemas["Separating"];
export type Robot = Schemas["Robot"];
export type Stopped = Schemas["Stopped"];
export type Quality = Schemas["Quality"];
export type Trend = Schemas["Trend"];
export type ChartLines = Schemas["ChartLines"];
export type ScanCodes = Schemas["ScanCodes"];
export type RefusedScan = Schemas["RefusedScan"];
export type Problem = Schemas["Problem"];

/** One message of the live feed, by its type. */
export type LiveMessage = Schemas["LiveMessage"];
export type LiveEvent = LiveMessage extends infer M
  ? M extends LiveMessage
    ? Pick<M, "type" | "data">
    : never
  : never;

export type RunKind =
  | "calibrate"
  | "check"
  | "diagnose"
  | "separate"
  | "apply"
  | "rollback"
  | "import"
  | "retract";
export type Outcome = NonNullable<Summary["outcome"]>;

/** An effect of the catalogue, or an unnamed error, and its place of action. */
export type EffectAt = Pick<Schemas["EffectName"], "effect" | "joint"> & {
  part?: string | null;
  label?: string;
  depends_on?: string | null;
};

export type Diagnosis = Schemas["DiagnosisDocument"];
export type DiagnosisVerdict = Diagnosis["verdict"];
export type Finding = Diagnosis["findings"][number];
export type Explanation = Diagnosis["explanations"][number];
/** An error of an explanation, with its size. */
export type Held = Explanation["effects"][number];
export type Experiment = Diagnosis["experiments"][number];
/** A wrong label in the file: which, and in which rows. */
export type Mistake = NonNullable<Diagnosis["mistake"]>;
/** A sentence, or a part of one, by its code. */
export type Phrase = Schemas["Phrase"];

/** Position error over the workspace, mm. */
export type PositionError = Schemas["PositionError"];

export type Role = NonNullable<SignedIn["role"]>;
export type DeviceDetail = Schemas["DeviceDetail"];
export type Found = Schemas["Found"];
export type WireExchange = Schemas["WireExchange"];
export type WireList = Schemas["WireList"];
export type Delivery = Schemas["Delivery"];
export type DeliveryList = Schemas["DeliveryList"];
export type BackupMade = Schemas["BackupMade"];
export type BackupDrill = Schemas["BackupDrill"];
export type User = Schemas["User"];
export type ApiKey = Schemas["ApiKey"];
export type NewKey = Schemas["NewKey"];
export type AuditEntry = Schemas["AuditEntry"];
export type AuditList = Schemas["AuditList"];
export type Versions = Schemas["Versions"];
export type Training = Schemas["TrainingView"];
export type Exercise = Schemas["Exercise"];
export type Challenge = Schemas["Challenge"];
