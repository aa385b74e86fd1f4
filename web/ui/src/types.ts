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
export type LiveEvent = LiveMessage extends infer M ? (M extends LiveMessage ? Pick<M, "type" | "data"> : never) : never;

/** An effect of the catalogue, and the joint it belongs to. */
export type EffectAt = Pick<Schemas["EffectName"], "effect" | "joint">;
export type Diagnosis = Schemas["DiagnosisDocument"];
