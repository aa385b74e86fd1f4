/** Answers of the service, as small as the page can use them. */
import { vi } from "vitest";
import { now } from "../src/live";
import type {
  Calibration,
  Diagnosis,
  Finding,
  Interlock,
  ResidualRow,
  Run,
  RunReading,
  Station,
  Summary,
} from "../src/types";

/** When the page last heard from the station, by its own clock. */
const HEARD_AT = now.value;

/** The page's clock stands there: a slow computer does not make the station silent. */
export function stopClock(): void {
  vi.spyOn(performance, "now").mockReturnValue(HEARD_AT);
  now.value = HEARD_AT;
}

export const summary = (given: Partial<Summary> = {}): Summary => ({
  id: 1,
  uid: "01997a6e-8e80-7000-8000-000000000001",
  robot_serial: "FB-1",
  kind: "calibrate",
  plan: "paper",
  of: null,
  operator: "ada",
  work_order: null,
  state: "succeeded",
  verdict: "pass",
  outcome: "good",
  reason: null,
  reason_code: null,
  reason_params: {},
  step: 4,
  steps: 4,
  created_at: "2024-03-05T07:00:00Z",
  started_at: null,
  ended_at: null,
  zero_offsets: [],
  ...given,
});

export const reading = (given: Partial<RunReading> = {}): RunReading => ({
  reading: 1,
  position: "A",
  x_mm: null,
  y_mm: null,
  theta1_deg: 90,
  theta2_deg: 90,
  scale_mm: 100,
  sd_mm: null,
  residual_mm: null,
  limit_mm: null,
  t_s: 1,
  walk: 1,
  ...given,
});

export const run = (given: Partial<Run> = {}): Run => ({
  id: 2,
  state: "running",
  uid: "01997a6e-8e80-7000-8000-000000000001",
  robot_serial: "FB-1",
  kind: "calibrate",
  plan: "paper",
  of: null,
  operator: "ada",
  work_order: null,
  started_at: null,
  elapsed_s: null,
  remaining_s: null,
  walk: null,
  progress: 0,
  step: 0,
  steps: 4,
  stops: [],
  readings: [],
  iterations: [],
  prompt: null,
  ...given,
});

export const interlock = (given: Partial<Interlock> = {}): Interlock => ({
  id: "door",
  text: "Door closed",
  ok: false,
  detail: "",
  own_text: false,
  limits: {},
  shows: "",
  last_trip: null,
  ...given,
});

export const stationNow = (given: Partial<Station> = {}): Station => ({
  station: {
    name: "Cell 3",
    emulated: false,
    limits: {},
    open: false,
    plans: ["paper", "full"],
    recommended_plan: "full",
  },
  devices: [{ name: "scale", kind: "scale", address: "a", state: "ok", text: "" }],
  interlocks: [],
  machine: null,
  workspace: { x: [-200, 200], y: [300, 500] },
  calibration: { robot_serial: "FB-1", locked: false, text: "", check: null, calibration_valid_until: null },
  retract: { needed: false, excess_mm: 0, text: "" },
  run: null,
  last: null,
  finished: null,
  ...given,
});

export const row = (given: Partial<ResidualRow> = {}): ResidualRow => ({
  reading: 1,
  position: "A",
  x_mm: 10,
  y_mm: 400,
  t_s: 1,
  theta1_deg: 91,
  theta2_deg: 89,
  approach1: 1,
  approach2: -1,
  travel_mm: 5,
  temperature_rise_k: null,
  before_mm: 0.01,
  by_effect_mm: [0.008],
  after_mm: 0.002,
  limit_mm: 0.005,
  ...given,
});

export const finding = (given: Partial<Finding> = {}): Finding => ({
  effect: "backlash",
  joint: 2,
  part: null,
  label: "backlash of joint 2",
  parameters: [{ name: "width_deg", value: 0.0496, sd: 0.0001, unit: "deg" }],
  share: 0.97,
  p_value: 1e-9,
  probability: null,
  alias_set: [{ effect: "backlash", joint: 2, part: null }],
  remedy: "Adjust the reducer.",
  remedy_said: null,
  separating_experiment: null,
  separating_experiment_said: null,
  ...given,
});

const stage = {
  model: "base",
  unknowns: 8,
  fit_rms_mm: 0.012,
  holdout_rms_mm: 0.013,
  holdout_max_mm: 0.03,
  confirm_rms_mm: null,
  confirm_max_mm: null,
  predicted_position_error_mm: { rms: 0.1, max: 0.2, bound_95: null },
  true_position_error_mm: null,
};

const weak_direction = {
  singular_ratio: null,
  text: "",
  said: null,
  sd_deg: null,
  blind: [],
  blind_said: [],
  remedies: [],
  remedy: null,
  remedy_said: null,
};

/** What `station solve` needs; the page shows none of it. */
const model = {} as Diagnosis["model"];

export const diagnosed = (given: Partial<Diagnosis> = {}): Diagnosis => ({
  schema: "station.diagnosis/1",
  data: { file: "a.csv", readings: 120, sha256: "", guessed: [] },
  noise: { sigma_mm: 0.002, source: "repeats", dof: 60 },
  verdict: "explained",
  confirmed: true,
  sentence: "",
  parameters: [],
  weak_direction,
  findings: [finding()],
  curves: [],
  stages: [],
  before: stage,
  after: stage,
  hints: [],
  invisible: [],
  outliers: [],
  outlier_reasons: [],
  outlier_reasons_said: [],
  fresh_outliers: [],
  explanations: [],
  experiments: [],
  mistake: null,
  model,
  ...given,
});

export const calibration = (given: Partial<Calibration> = {}): Calibration => ({
  ...summary(),
  metadata: {},
  method: "published",
  zero_offset_tolerance_deg: 1,
  machine: "five-bar",
  parameters: [],
  weak_direction: null,
  application: null,
  made_by: null,
  memory: null,
  fleet: null,
  lack_of_fit: null,
  lack_of_fit_reason: null,
  accuracy: null,
  advice: [],
  check: null,
  references: [],
  prompt: null,
  before: null,
  after: null,
  iterations: [],
  residuals: [],
  findings: [],
  ...given,
});
