/**
 * Every text of the page in English.
 *
 * Names of effects and parameters are written as they stand in the middle of a sentence; where one stands
 * alone, the style sheet writes its first letter large.  Another language is another file of the same shape.
 */
import type { ApplicationState, Device, Diagnosis, Plan, State, Verdict } from "../types";

/** How a thing is called, and what it is in one sentence. */
interface Entry {
  name: string;
  explanation: string;
}

export const en = {
  language: "en",
  title: "Calibration station",
  listed: (parts: string[]) => parts.join(", "),

  /** By the identifier of the catalogue. */
  effects: {
    backlash: {
      name: "backlash",
      explanation:
        "Play between gear and arm: the angle depends on the direction from which the joint arrives.",
    },
    gear_cyclic: {
      name: "gear ripple",
      explanation:
        "Teeth and bearings of the gear repeat an angle error several times per revolution of the joint.",
    },
    encoder_eccentricity: {
      name: "encoder eccentricity",
      explanation:
        "The encoder disc is off-centre: the angle error repeats once per revolution of the joint.",
    },
    transmission_gain: {
      name: "transmission ratio error",
      explanation: "The joint turns more or less than the drive counts, in proportion to the angle.",
    },
    compliance: {
      name: "drive train compliance",
      explanation: "The drive train yields to gravity: the arm sags most when it is horizontal.",
    },
    count_slip: {
      name: "lost counts",
      explanation:
        "A belt jumped, a coupling slipped or counts were lost: the angle has a step at one moment.",
    },
    link_length: {
      name: "link length error",
      explanation: "The length of a link differs from its nominal value by more than the tolerance.",
    },
    joint_clearance: {
      name: "passive joint clearance",
      explanation:
        "The pin of a passive joint moves within its bearing to the side to which the load pulls it.",
    },
    scale_gain: {
      name: "scale gain error",
      explanation: "The graduation of the scale is too long or too short.",
    },
    scale_bow: {
      name: "bent scale guide",
      explanation: "The guide of the scale is bent: the error grows with the square of the travel.",
    },
    scale_cyclic: {
      name: "periodic scale error",
      explanation:
        "The graduation, its interpolation or a rolling element repeats an error along the travel.",
    },
    scale_hysteresis: {
      name: "scale hysteresis",
      explanation: "The reading depends on the direction of the last motion of the slider.",
    },
    drift: {
      name: "drift",
      explanation: "The reading changes in proportion to time.",
    },
    thermal_growth: {
      name: "thermal growth",
      explanation: "Links or scale grow while the machine warms up.",
    },
  } satisfies Record<string, Entry>,
  /** An effect and where it acts. */
  effectAt: {
    joint: (effect: string, joint: string | number) => `${effect} of joint ${joint}`,
    links: (effect: string) => `${effect} of the links`,
    curve: (effect: string) => `${effect} curve`,
  },

  /** By the identifier without the number of a joint, link or wave. */
  parameters: {
    width_deg: { name: "width", explanation: "Angle between the two directions of approach." },
    width_mm: { name: "width", explanation: "Distance between the two directions of motion." },
    amplitude_deg: { name: "amplitude", explanation: "Largest angle error of the wave." },
    amplitude_mm: { name: "amplitude", explanation: "Largest error of the wave." },
    phase_deg: { name: "phase", explanation: "Phase of the wave at the origin." },
    per_rev: { name: "cycles per revolution", explanation: "Number of waves per revolution of the joint." },
    rms_deg: { name: "RMS", explanation: "Root mean square of the angle error over the range of the joint." },
    period_mm: { name: "period", explanation: "Travel of the scale after which the error repeats." },
    ppm: { name: "relative error", explanation: "Error in millionths of the angle or of the travel." },
    deg_at_horizontal: {
      name: "sag when horizontal",
      explanation: "Angle by which the horizontal arm sags.",
    },
    deg_at_horizontal_per_kg: {
      name: "sag per payload when horizontal",
      explanation: "Angle by which the horizontal arm sags per kilogram of payload.",
    },
    deg_at_full_reach: {
      name: "sag at full reach",
      explanation: "Angle by which the outstretched arm sags.",
    },
    step_deg: { name: "step", explanation: "Angle by which the joint has shifted." },
    from_s: { name: "time of the step", explanation: "Time since the first reading." },
    mm: { name: "clearance", explanation: "Displacement of the pin in its bearing." },
    mm_at_100_mm: { name: "error at 100 mm", explanation: "Error at 100 mm of travel from the centre." },
    mm_per_hour: { name: "rate", explanation: "Change of the reading per hour." },
    links_um_per_m: { name: "growth of the links", explanation: "Growth per length when warm." },
    links_um_per_m_per_K: {
      name: "growth of the links",
      explanation: "Growth per length and temperature rise.",
    },
    scale_um_per_m: { name: "growth of the scale", explanation: "Growth per travel when warm." },
    scale_um_per_m_per_K: {
      name: "growth of the scale",
      explanation: "Growth per travel and temperature rise.",
    },
    mounting_mm: { name: "shift of the scale mounting", explanation: "Shift of the reading when warm." },
    mounting_um_per_K: {
      name: "shift of the scale mounting",
      explanation: "Shift of the reading per temperature rise.",
    },
    tau_s: { name: "time constant", explanation: "Time after which 63 % of the growth is reached." },
    dtheta: {
      name: "zero offset",
      explanation: "Difference between the zero of the drive and that of the joint.",
    },
    L: { name: "length error of proximal link", explanation: "Deviation from the length in the robot file." },
    l: { name: "length error of distal link", explanation: "Deviation from the length in the robot file." },
    ex: { name: "error in x of base joint", explanation: "Deviation from the position in the robot file." },
    ey: { name: "error in y of base joint", explanation: "Deviation from the position in the robot file." },
    rho0: { name: "reading offset", explanation: "Reading of the scale at distance zero." },
    alpha: { name: "twist angle error of link", explanation: "Deviation from the angle in the robot file." },
    beta: { name: "parallelism error of joint", explanation: "Deviation from the angle in the robot file." },
    a: { name: "length error of link", explanation: "Deviation from the length in the robot file." },
    b: { name: "lateral offset error of link", explanation: "Deviation from the offset in the robot file." },
    d: { name: "offset error of link", explanation: "Deviation from the offset in the robot file." },
    tool: {
      name: "tool position",
      explanation: "Position of the measured point in the frame of the flange.",
    },
    origin: {
      name: "instrument position",
      explanation: "Position of the instrument in the frame of the robot.",
    },
    base: { name: "base position", explanation: "Position of the robot in the frame of the instrument." },
    base_r: { name: "base rotation", explanation: "Rotation of the robot in the frame of the instrument." },
    rMx: {
      name: "mounting error of the mechanism, x",
      explanation: "Offset of the measuring mechanism from its nominal position, in x.",
    },
    rMy: {
      name: "mounting error of the mechanism, y",
      explanation: "Offset of the measuring mechanism from its nominal position, in y.",
    },
  } satisfies Record<string, Entry>,
  numbered: (name: string, number: string) => `${name} ${number}`,
  /** By the unit that the service states. */
  units: {
    deg: "°",
    "deg/kg": "°/kg",
    "um/m": "µm/m",
    "um/m/K": "µm/(m K)",
    "um/K": "µm/K",
    "1/rev": "",
  } satisfies Record<string, string>,

  plans: {
    paper: {
      name: "Paper",
      explanation: "The published method: it identifies the zero offsets in several passes.",
    },
    rapid: { name: "Rapid", explanation: "Few readings; it uses the stored parameters of the robot." },
    full: {
      name: "Full",
      explanation: "24 positions from both sides; it also identifies geometry and mounting.",
    },
    diagnostic: {
      name: "Find the cause",
      explanation:
        "120 readings that identify the cause of the residual, and 40 fresh readings that check it.",
    },
  } satisfies Record<Plan, Entry>,
  /** What else a run can be. */
  runKinds: {
    apply: {
      name: "Apply to drives",
      explanation: "The zero offsets are written to the drives and verified.",
    },
    rollback: { name: "Roll back", explanation: "The earlier zero offsets are written to the drives." },
    separating: {
      name: "Separating experiment",
      explanation: "More readings distinguish the alternative explanations of a diagnosis.",
    },
    dataset: { name: "Imported measurements", explanation: "The readings come from a file." },
  } satisfies Record<string, Entry>,
  methods: {
    published: {
      name: "Published method",
      explanation: "Linear equations of the paper, solved pass by pass.",
    },
    "measurement model": {
      name: "Measurement model",
      explanation: "Least squares over zero offsets, geometry and mounting, with their tolerances.",
    },
    diagnosis: {
      name: "Diagnosis",
      explanation: "The measurement model, extended by effects of the catalogue.",
    },
  } satisfies Record<string, Entry>,

  states: {
    queued: { name: "waiting", badge: "WAITING", explanation: "The run has not started yet." },
    running: { name: "running", badge: "RUNNING", explanation: "The run is in progress." },
    succeeded: { name: "completed", badge: "NO VERDICT", explanation: "The run was completed." },
    failed: { name: "failed", badge: "FAILED", explanation: "The run ended with an error." },
    aborted: { name: "aborted", badge: "ABORTED", explanation: "An operator ended the run." },
    interrupted: {
      name: "interrupted",
      badge: "INTERRUPTED",
      explanation: "The station was restarted during the run. The run does not continue.",
    },
  } satisfies Record<State, Entry & { badge: string }>,
  verdicts: {
    pass: { name: "pass", badge: "PASS", explanation: "The result meets its limits." },
    fail: { name: "fail", badge: "FAIL", explanation: "The result does not meet its limits." },
  } satisfies Record<Verdict, Entry & { badge: string }>,
  diagnoses: {
    adequate: { name: "adequate", explanation: "The model fits the readings. No effect is missing from it." },
    explained: { name: "explained", explanation: "With the effects found, the model fits the readings." },
    ambiguous: {
      name: "not certain",
      explanation: "Several explanations fit the readings, and these readings cannot distinguish them.",
    },
    partly_explained: {
      name: "partly explained",
      explanation: "The effects found reduce the residual, but it is still larger than the noise.",
    },
    unexplained: {
      name: "unexplained",
      explanation: "The residual is larger than the noise, and no effect of the catalogue explains it.",
    },
  } satisfies Record<Diagnosis["verdict"], Entry>,
  applications: {
    unwritten: { name: "old zero offset", explanation: "The drive has not been written." },
    applied: { name: "new zero offset", explanation: "The drive has accepted the new zero offset." },
    partly: { name: "partly written", explanation: "Only some of the drives have the new zero offset." },
    "in doubt": { name: "unknown", explanation: "It is unknown whether the drive accepted its new zero." },
    "rolled back": {
      name: "old zero offset restored",
      explanation: "The drive has its old zero offset again.",
    },
    superseded: { name: "changed since", explanation: "A later run has written the drive." },
  } satisfies Record<ApplicationState, Entry>,
  devices: {
    ok: { name: "ok", explanation: "The device responds." },
    unknown: { name: "not checked yet", explanation: "The device has not been asked yet." },
    lost: { name: "lost", explanation: "The device does not respond." },
    fault: { name: "fault", explanation: "The device reports a fault." },
  } satisfies Record<Device["state"], Entry>,

  /** By the name of the stage; the others are effects. */
  stages: {
    paper: { name: "published model", explanation: "Zero offsets and mounting; the geometry is nominal." },
    nominal: { name: "nominal model", explanation: "Base and tool; the geometry is nominal." },
    base: { name: "base model", explanation: "Zero offsets, geometry and mounting, without effects." },
  } satisfies Record<string, Entry>,
  added: (effect: string) => `+ ${effect}`,

  shared: {
    loading: "Loading …",
    run: (id: number) => `run ${id}`,
    result: (id: number) => `Result ${id}`,
    report: "Report",
    readingsCsv: "Readings (CSV)",
    operator: "Operator",
    confirm: "Confirm",
    confirmLabel: (label: string) => `Confirm: ${label}`,
    back: "Back",
    /** Before every motion; the first part is emphasised. */
    willMove: (serial: string) => `Robot ${serial} will move`,
    clear: "Keep clear of its reach.",
    chartMissing: "▲ The chart could not be loaded. Reload the page.",
    expanded: (k: number) => `U is the expanded uncertainty (k = ${k}).`,
    standard: (value: string) => `standard uncertainty ${value}`,
    within: "within",
    over: "▲ over",
    outside: "◆ outside",
    stepOf: (step: number, steps: number | string) => `step ${step} of ${steps}`,
    waiting: "Waiting to start",
  },

  refusals: {
    noAnswer: "The station does not respond.",
    status: (status: number) => `The station responded with HTTP status ${status}.`,
  },

  header: {
    views: "Views",
    station: "Station",
    result: "Result",
    history: "History",
    offline: "▲ OFFLINE",
    stale: "values may be old",
    connected: "connected",
    connecting: "connecting …",
    notConnected: "CONNECTING",
    running: "RUNNING",
    waiting: "WAITING",
    notReady: "◆ NOT READY",
    ready: "READY",
    device: (name: string, state: string) => `▲ ${name}: ${state}`,
    emulated: (name: string) => `${name} (emulated)`,
  },

  stop: {
    button: "STOP",
    notEmergency: "not the emergency stop",
    mayNotArrive: (at: string) =>
      `Offline: the stop requested at ${at} may not reach the station. Press the emergency stop.`,
    stopping: (at: string) => `Stopping, requested at ${at} …`,
    stopped: (at: string) => `Stopped at ${at}: both drives confirmed.`,
    failed: (at: string, cause: string) => `STOP FAILED at ${at}: ${cause} Press the emergency stop.`,
  },

  station: {
    title: "Station",
    start: "Start a calibration",
    serial: "Robot serial",
    plan: "Plan",
    calibrate: "Calibrate",
    confirmStart: "Confirm the start",
    serialMissing: "Scan or type the serial number of the robot.",
    operatorMissing: "Scan or type the name of the operator.",
    devices: "Devices",
    interlocks: "Interlocks",
    interlockOk: "ok",
    interlockNotMet: "◆ not met",
    run: "Run",
    noRun: "No run in progress",
    runLine: (serial: string, id: number, operator: string) => `${serial} · run ${id} · ${operator}`,
    progress: "Progress",
    remaining: (duration: string) => `about ${duration} left in this pass`,
    abort: "Abort run",
    scale: "Scale",
    age: "Age",
    old: "◆ old",
    noValues: "no values",
    readings: "Readings",
    readingsTitle: (count: number) => (count > 0 ? `Readings (${count})` : "Readings"),
    noReadings: "No readings yet.",
    number: "No.",
    position: "Position",
    scaleMm: "Scale, mm",
    residualUm: "Residual, µm",
    limitUm: "Limit, µm",
    verdict: "Verdict",
    mapUnknown: "Workspace, not known yet",
    map: (done: number, all: number) => `Workspace: ${done} of ${all} positions of this pass done`,
    xAxis: "x, mm",
    yAxis: "y, mm",
    done: "done",
    partly: "partly",
    planned: "planned",
    robot: "robot",
  },

  result: {
    title: "Result",
    heading: (id: number) => `Result of run ${id}`,
    headingOf: (id: number, kind: string, of: number) => `Result of run ${id}: ${kind} (run ${of})`,
    none: "No run has ended yet.",
    waiting: "Waiting for the station …",
    plan: "Plan",
    workOrder: "Work order",
    started: "Started",
    duration: "Duration",
    method: "Method",
    diagnosis: "Diagnosis",
    robotHistory: "History of this robot",
    noOffsets: "No zero offsets were identified in this run.",
    pending: "The result follows the last reading.",

    offsets: "Zero offsets, in °",
    joint: "Joint",
    value: "Value ± U",
    standardUncertainty: "Standard uncertainty",
    tolerance: "Tolerance",
    verdict: "Verdict",
    alsoIdentified: "Also identified",
    valueIn: (value: string, unit: string) => `${value} ${unit}`,

    weakDirection: "Weakest direction",
    remedy: (text: string) => `Recommended: ${text}`,

    passes: "Passes, in °",
    pass: "Pass",
    change: (joint: number) => `Change ${joint}`,
    total: (joint: number) => `Total ${joint}`,
    accuracy: "Compensation accuracy",

    residuals: "Residual of each reading",
    residualsNote: (count: number, largest: string, over: number) =>
      `${count} readings, largest residual ${largest} µm; ${
        over === 0 ? "none exceeds its limit." : `${over} over the limit (diamonds).`
      }`,
    residualsChart: "Chart of the residuals against their limits",
    readingAxis: "reading",
    residualAxis: "residual, µm (dashed: limits)",

    drives: "Drives",
    step: (title: string, step: string) => `▶ ${title}: ${step}`,
    verified: "Verified.",
    notVerified: "Not verified.",
    apply: "Apply to drives",
    applyWarning: ", and its drives receive new zeros.",
    rollBack: "Roll back",
    rollBackWarning: ", and its drives receive their old zeros.",
    identified: "Identified, °",
    shift: "Shift of the drive, °",
    remaining: "Remaining, °",
    drive: "Drive",
    attempt: (kind: string, id: number) => `${kind}, run ${id}`,

    memory: (serial: string) => `Stored parameters of robot ${serial}`,
    memoryUsed: "Used",
    memoryNotUsed: "◆ Not used",
    memoryText: (text: string) => `: ${text} (`,
    memoryAge: (days: string, p: string) => `, ${days} days earlier; p-value ${p}).`,
    memoryNone: "This run used no stored parameters.",
    memoryNext: (id: number, days: string) =>
      `The next rapid or full run starts from run ${id}, which is ${days} days old.`,
    memoryNextNone: "The next run starts without stored parameters.",
    forget: "Delete",
    forgetWarning: (serial: string) => `The next run of robot ${serial} will start `,
    forgetEmphasis: "without stored parameters",
    forgetAs: ". This is necessary after the mechanism was remounted.",

    cause: "Cause",
    checkModel: "Check the model for missing effects",
    misfit: "◆ The model does not fit these readings",
    misfitOffsets: (lack: string) =>
      `An effect is missing from the model. The zero offsets may be in error by more than their uncertainty: ${lack}.`,
    misfitNone:
      "No robot within its tolerances gives these readings. An effect is missing from the model, or the robot file belongs to another robot.",
    findCauseNote:
      "A measurement sequence of 120 readings shows what the residual depends on and identifies its cause. Then 40 fresh readings check the result.",
    findCause: "Find the cause",
    wholeWorkspace: " over its whole workspace.",
  },

  accuracy: {
    title: "Before and after",
    before: "Before",
    after: "After",
    without: "Without the effects",
    with: "With the effects",
    readings: "Residual of the readings, RMS, µm",
    fresh: "Residual of fresh readings, RMS, µm",
    position: "Predicted position error, RMS, mm",
    largest: "Predicted position error, largest, mm",
  },

  diagnosis: {
    title: "Diagnosis",
    heading: (id: number) => `Diagnosis of run ${id}`,
    noiseFromRepeats: (count: number, sigma: string, dof: number) =>
      `${count} readings. The noise of one reading is ${sigma} µm, estimated from ${dof} repeats.`,
    noiseSpecified: (count: number, sigma: string) =>
      `${count} readings. The noise of one reading is ${sigma} µm, as specified.`,
    outliers: (readings: string) => `Outliers, not used: reading ${readings}.`,

    causes: "Causes",
    tried: "Effects tested; none of them is the cause",
    noEffect: "The model contains no effect of the catalogue.",
    effect: (rank: number) => `Effect ${rank}`,
    size: "Size ± U",
    share: "Share of the residual",
    alternatives: "Alternative explanations",
    noAlternative: "no other effect of the catalogue",
    remedy: "Remedy",
    toDistinguish: (experiment: string) => `To distinguish the alternatives: ${experiment}`,
    meaning: "Meaning of the parameters",

    hints: "Hints",
    hintsTitle: "What the remaining residual depends on",
    hint: (text: string, percent: string) => `${text} (${percent} %)`,

    distinguish: "Distinguish the alternative explanations",
    planning: "Planning …",
    moreReadings: (count: number) =>
      `${count} more readings, at the positions where the models differ most, should distinguish the effect found from `,
    freshReadings: (count: number, duration: string) =>
      `. Then ${count} fresh readings check the result. Duration: about ${duration}.`,
    continues: "The experiment continues this run. Until then, do not change scale, drives or mechanism.",
    runSeparating: "Run the separating experiment",
    workspace: " over its workspace.",
    planned: (count: number, left: string, right: string, bottom: string, top: string) =>
      `${count} planned positions, x from ${left} to ${right} mm, y from ${bottom} to ${top} mm`,

    residual: "Residual",
    residualTitle: "Residual of each reading",
    orderBy: "Order the residual by",
    before: "Before",
    after: "After",
    beforeName: "measured value minus base model",
    afterName: "residual with the effects in the model",
    contribution: (effect: string) => `contribution of ${effect}`,
    caption: (rms: string, largest: string) => `${rms} µm RMS, largest ${largest} µm`,
    chart: (title: string, series: string, by: string) => `${title}: ${series}, by ${by}`,
    legendMean: (name: string) => `● ${name}, mean of each position; ○ negative; the area shows the size`,
    legendLimit: (limit: string) => `┄ limit ${limit} µm`,
    legendOver: (count: number) => `◆ ${count} over the limit`,
    orderings: {
      time: { name: "Time", axis: "time, s" },
      order: { name: "Order", axis: "number of the reading" },
      position: { name: "Position", axis: "x, mm" },
      joint1: { name: "Joint 1", axis: "angle of joint 1, °" },
      joint2: { name: "Joint 2", axis: "angle of joint 2, °" },
      approach1: { name: "Approach 1", axis: "approach of joint 1" },
      approach2: { name: "Approach 2", axis: "approach of joint 2" },
      travel: { name: "Travel", axis: "travel of the scale, mm" },
      temperature: { name: "Temperature", axis: "temperature rise, K" },
    },
    fromAbove: "from above",
    unknownSide: "unknown",
    fromBelow: "from below",
    micrometre: "µm",
    yAxis: "y, mm",
    xAxisMean: (largest: string) => `x, mm (largest mean ${largest} µm)`,

    errors: "Errors",
    errorsTitle: "Residuals of the models, in µm",
    model: "Model",
    unknowns: "Unknowns",
    fit: "Fit, RMS",
    leftOut: "Position left out, RMS",
    fresh: "Fresh, RMS",
    freshLargest: "Fresh, largest",

    notFound: "Not found",
    notFoundTitle: "Effects not found, and their detection limits",
    notFoundNote:
      "Smaller effects may be present. An effect of the size shown is detected with 80 % probability.",
    effectColumn: "Effect",
    detectionLimit: "Detection limit",
    quantity: "Quantity",
    remark: "Remark",
  },

  history: {
    title: "History",
    runs: "Runs",
    run: "Run",
    started: "Started",
    robot: "Robot",
    outcome: "Outcome and reason",
    offset: (joint: number) => `Offset ${joint} ± U, °`,
    readings: "Readings",
    csv: "CSV",
    csvLabel: (id: number) => `Readings of run ${id}, CSV`,
    kindOf: (kind: string, of: number) => `${kind} (run ${of})`,
    noMatch: "No run matches.",
    trouble: (text: string) => `▲ ${text}`,
    newest: "Newest",
    older: "Older",
    filter: "Filter",
    serial: "Robot serial",
    state: "State",
    verdict: "Verdict",
    from: "From",
    to: "To",
    all: "all",
  },
};
