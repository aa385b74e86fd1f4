/** Answers of the service, as small as the page can use them. */
import type { Diagnosis, ResidualRow, Run, RunReading, Station, Summary } from "../src/types";

export const summary = (given: Partial<Summary> = {}): Summary => ({
  id: 1,
  robot_serial: "FB-1",
  plan: "paper",
  of: null,
  operator: "ada",
  work_order: null,
  state: "succeeded",
  verdict: "pass",
  reason: null,
  step: 4,
  steps: 4,
  created_at: "2024-03-05T07:00:00Z",
  started_at: null,
  ended_at: null,
  zero_offsets: null,
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

type Finding = Diagnosis["findings"][number];

export const finding = (given: Partial<Finding> = {}): Finding => ({
  effect: "backlash",
  joint: 2,
  parameters: [{ name: "width_deg", value: 0.0496, sd: 0.0001, unit: "deg" }],
  share: 0.97,
  alias_set: [{ effect: "backlash", joint: 2 }],
  remedy: "Adjust the reducer.",
  separating_experiment: null,
  ...given,
});

export const diagnosed = (given: Partial<Diagnosis> = {}): Diagnosis => ({
  verdict: "explained",
  confirmed: true,
  sentence: "",
  noise: { sigma_mm: 0.002, source: "repeats", dof: 60 },
  outliers: [],
  findings: [finding()],
  stages: [],
  hints: [],
  invisible: [],
  ...given,
});
