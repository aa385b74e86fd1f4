/** Answers of the service, as small as the page can use them. */
import type {
  Calibration,
  Diagnosis,
  Finding,
  ResidualRow,
  Run,
  RunReading,
  Station,
  Summary,
} from "../src/types";

export const summary = (given: Partial<Summary> = {}): Summary => ({
  id: 1,
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
  step: 0,
  steps: 4,
  stops: [],
  readings: [],
  iterations: [],
  ...given,
});

export const stationNow = (given: Partial<Station> = {}): Station => ({
  station: { name: "Cell 3", emulated: false, limits: {}, plans: ["paper", "full"] },
  devices: [{ name: "scale", kind: "scale", address: "a", state: "ok", text: "" }],
  interlocks: [],
  machine: null,
  workspace: { x: [-200, 200], y: [300, 500] },
  retract: { needed: false, excess_mm: 0, text: "" },
  run: null,
  last: null,
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
  label: "backlash of joint 2",
  parameters: [{ name: "width_deg", value: 0.0496, sd: 0.0001, unit: "deg" }],
  share: 0.97,
  p_value: 1e-9,
  alias_set: [{ effect: "backlash", joint: 2 }],
  remedy: "Adjust the reducer.",
  separating_experiment: null,
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
  predicted_position_error_mm: { rms: 0.1, max: 0.2 },
  true_position_error_mm: null,
};

const weak_direction = {
  singular_ratio: null,
  text: "",
  sd_deg: null,
  blind: [],
  remedies: [],
  remedy: null,
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
  fresh_outliers: [],
  model,
  ...given,
});

export const calibration = (given: Partial<Calibration> = {}): Calibration => ({
  ...summary(),
  metadata: {},
  method: "published",
  zero_offset_tolerance_deg: 1,
  parameters: [],
  weak_direction: null,
  application: null,
  memory: null,
  lack_of_fit: null,
  before: null,
  after: null,
  iterations: [],
  residuals: [],
  findings: [],
  ...given,
});
