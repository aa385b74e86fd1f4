/**
 * Every text of the page in English.
 *
 * Texts shared with the service (effects, parameters, plans, states, verdicts, outcomes, kinds of run,
 * reasons) are in `station/messages`; this file has only the page's own. Another language is another pair of
 * files of the same shape.
 */
import shared from "../../../../station/messages/en.json";
import type {
  ApplicationState,
  Device,
  DiagnosisVerdict,
  Outcome,
  Plan,
  RunKind,
  State,
  Verdict,
} from "../types";
import { maintenance, training } from "./en-maintenance";

/** The name of a thing, and its explanation in one sentence. */
interface Entry {
  name: string;
  text: string;
}

export const en = {
  language: "en",
  title: "Calibration station",
  listed: (parts: string[]) => parts.join(", "),

  /** By the identifier of the catalogue; `unnamed` is an error outside it. */
  /** Sentences that the station produces in English only. */
  sentences: {} as Record<string, string>,
  effects: shared.effects satisfies Record<string, Entry>,
  /** An effect and its place of action. */
  effectAt: {
    joint: (effect: string, joint: string | number) => `${effect} of joint ${joint}`,
    part: (effect: string, part: string) => `${effect} of ${part}`,
    curve: (effect: string) => `${effect} curve`,
    dependent: (effect: string, on: string) => `${effect} that depends on ${on}`,
  },
  /** By the identifier, with {n} for the number of a joint, link or wave and {axis} for x, y or z. */
  parameters: shared.parameters satisfies Record<string, Entry>,
  labels: shared.labels satisfies Record<string, string>,
  parts: shared.parts satisfies Record<string, string>,
  dependences: shared.dependences satisfies Record<string, string>,
  mounted: (name: string, mount: string) => `${name} (mount ${mount})`,
  both: (names: string[]) =>
    names.length < 2 ? names.join("") : `${names.slice(0, -1).join(", ")} and ${names.at(-1)}`,

  plans: shared.plans satisfies Record<Plan, Entry>,
  runKinds: shared.run_kinds satisfies Record<RunKind, Entry>,
  methods: {
    published: {
      name: "Published method",
      text: "Linear equations of the paper, solved pass by pass.",
    },
    "measurement model": {
      name: "Measurement model",
      text: "Least squares over zero offsets, geometry and mounting, with their tolerances.",
    },
    diagnosis: {
      name: "Diagnosis",
      text: "The measurement model, extended by effects of the catalogue.",
    },
  } satisfies Record<string, Entry>,

  states: shared.states satisfies Record<State, Entry>,
  /** Verdicts of a run and of a diagnosis. */
  verdicts: shared.verdicts satisfies Record<Verdict | DiagnosisVerdict, Entry>,
  outcomes: shared.outcomes satisfies Record<Outcome, Entry>,
  /** Templates with the values of `reason_params`. */
  reasons: shared.reasons satisfies Record<string, string>,
  applications: {
    unwritten: { name: "old zero offset", text: "The drive has not been written." },
    applied: { name: "new zero offset", text: "The drive has accepted the new zero offset." },
    partly: { name: "partly written", text: "Only some of the drives have the new zero offset." },
    "in doubt": { name: "unknown", text: "It is unknown whether the drive accepted its new zero." },
    "rolled back": {
      name: "old zero offset restored",
      text: "The drive has its old zero offset again.",
    },
    superseded: { name: "changed since", text: "A later run has written the drive." },
  } satisfies Record<ApplicationState, Entry>,
  devices: {
    ok: { name: "ok", text: "The device responds." },
    unknown: { name: "not checked yet", text: "The device has not been asked yet." },
    lost: { name: "lost", text: "The device does not respond." },
    fault: { name: "fault", text: "The device reports a fault." },
  } satisfies Record<Device["state"], Entry>,

  /** By the name in the service. */
  deviceNames: {
    "linear scale": "linear scale",
    "servo axis 1": "servo axis 1",
    "servo axis 2": "servo axis 2",
  } as Record<string, string>,
  /** By identifier. */
  interlocks: {
    devices: "All devices answer",
    drives: "Both drives are ready",
    workspace: "The arm stands within its workspace",
    scale: "The scale reads",
    travel: "The scale moves as far as the joints say",
    following_error: "Each joint keeps to its way",
    guard_door: "The guard door is closed",
    temperature: "The temperature is within its window",
    reference_check: "The reference check is valid",
  } as Record<string, string>,
  /** By the name of the stage; the others are effects. */
  stages: {
    paper: { name: "Published model", text: "Zero offsets and mounting; the geometry is nominal." },
    nominal: { name: "Nominal model", text: "Base and tool; the geometry is nominal." },
    base: { name: "Base model", text: "Zero offsets, geometry and mounting, without effects." },
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
    /** Below the name of a button. */
    hold: "hold for 1 s",
    armedFor: (seconds: number) => `Hold the button, or scan the confirmation code, within ${seconds} s.`,
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
    noVerdict: "No verdict",
    verdict: (verdict: string) => `Verdict: ${verdict}`,
  },

  refusals: {
    noAnswer: "The station does not respond.",
    status: (status: number) => `The station responded with HTTP status ${status}.`,
  },

  scan: {
    notSerial: (text: string) => `Not a serial: ${text}`,
    /** Read while a secret was being typed: its text is not shown. */
    unknown: "Not a badge. Nothing was entered.",
    unreadable: "The code could not be read completely. Scan it again.",
    nothingToConfirm: "Nothing waits for a confirmation. Press what is to be done first.",
    noCodes: "The station has not sent its codes yet. Scan again.",
    signInFirst: "Sign in first.",
    signedOn: (name: string) => `Operator: ${name}`,
  },
  signIn: {
    badge: "Sign in with your badge",
    pin: "PIN",
    scanBadge: "Or scan your badge.",
    title: "Sign in",
    first: "Make the first administrator",
    name: "Name",
    password: "Password",
    button: "Sign in",
    as: (name: string, role: string) => `Signed in: ${name}, ${role}`,
    out: "Sign out",
    open: "OPEN: anybody at this computer may start runs; nobody signs in (emulated machine)",
    stopWithout: "At this computer the stop works without signing in.",
    withProvider: (label: string) => `Sign in with ${label}`,
    refused: {
      unreachable:
        "The provider does not answer. Try again later, or sign in with a password of this station.",
      cancelled: "The sign-in was cancelled at the provider.",
      expired: "The sign-in took too long, or was begun in another browser. Begin again.",
      not_valid: "The answer of the provider cannot be used. The log of the station has the cause.",
      no_role:
        "The provider knows you, but none of your groups has a role at this station. Ask its administrator.",
      name_taken: "This station has a user of your name who signs in with a password. Ask its administrator.",
      disabled: "Your user at this station is disabled. Ask its administrator.",
    },
  },
  header: {
    views: "Views",
    station: "Station",
    result: "Result",
    history: "History",
    maintenance: "Maintenance",
    offline: "▲ OFFLINE",
    stale: "values may be old",
    connected: "connected",
    connecting: "connecting …",
    notConnected: "CONNECTING",
    signInFirst: "NOT SIGNED IN",
    notReady: "◆ NOT READY",
    ready: "READY",
    device: (name: string, state: string) => `▲ ${name}: ${state}`,
    language: "Language",
    emulated: (name: string) => `${name} (emulated)`,
  },

  stop: {
    button: "STOP",
    notEmergency: "not the emergency stop",
    mayNotArrive: (at: string) =>
      `Offline: the stop requested at ${at} may not reach the station. Press the emergency stop.`,
    stopping: (at: string) => `Stopping, requested at ${at} …`,
    stopped: (at: string) => `Stopped at ${at}: both drives confirmed.`,
    wasFailed: (at: string) =>
      `The stop requested at ${at} was not confirmed. The station responds again: check that nothing moves.`,
    failed: (at: string, cause: string) => `STOP FAILED at ${at}: ${cause} Press the emergency stop.`,
  },

  station: {
    title: "Station",
    start: "Start a calibration",
    serial: "Robot serial",
    plan: "Plan",
    recommended: (plan: string) => `${plan} (recommended)`,
    calibrate: "Calibrate",
    accuracy: "Wanted accuracy, mm",
    optional: "optional",
    references: "References from other instruments",
    joint: "Joint",
    driveSays: "The drive says, °",
    levelReads: "The level reads, °",
    levelSd: "Standard uncertainty of the level, °",
    mounting: "Mounting error sideways, mm",
    mountingSd: "Its standard uncertainty, mm",
    wishWrong: "Give a number, or leave all fields that belong together empty.",
    effort: (readings: number, time: string) => `${readings} readings, about ${time}.`,
    promise: (bound: string) => ` A robot within its tolerances then errs by at most ${bound} mm (95 %).`,
    promptValue: (unit: string) => `Value, ${unit}`,
    promptNumber: (unit: string) => `Type a number, in ${unit}.`,
    promptLeft: (time: string) => `The run ends if nobody answers within ${time}.`,
    promptSend: "Answer",
    promptAnswer: (answer: string) => `Answer: ${answer}.`,
    promptDone: "Done",
    locked: "Calibrated work is locked",
    serialMissing: "Scan or type the serial number of the robot.",
    operatorMissing: "Scan or type the name of the operator.",
    devices: "Devices",
    interlocks: "Interlocks",
    interlockOk: "ok",
    interlockNotMet: "◆ not met",
    lastTrip: (run: number, frameMs: number | null, standstillMs: number) =>
      `Stopped run ${run}: ${frameMs === null ? "" : `stop frames sent after ${frameMs} ms, `}standstill seen after ${standstillMs} ms`,
    /** State of devices and interlocks while the station does not answer. */
    notKnown: "not known",
    run: "Run",
    noRun: "No run in progress",
    wayBack: "Way back",
    retract: "Move back into the workspace",
    retractHow: " Both joints move slowly, step by step, until the arm stands inside.",
    runLine: (serial: string, id: number, operator: string) => `${serial} · run ${id} · ${operator}`,
    progress: "Progress",
    remaining: (duration: string) => `about ${duration} left in this sequence`,
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
    kind: "Kind of run",
    plan: "Plan",
    workOrder: "Work order",
    started: "Started",
    duration: "Duration",
    method: "Method",
    diagnosis: "Diagnosis",
    robotHistory: "History of this robot",
    gaugeStudy: (form: string) => `Gauge study (${form})`,
    certificate: (form: string) => `Certificate (${form})`,
    run: "Run, plan, operator and times",
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

    notValid: "not valid",
    notValidNote: "This run was not accepted. Its numbers must not be used.",

    decision: {
      limited: (bound: string, limit: string) =>
        `position error at most ${bound}\u00a0mm (95\u00a0%), limit ${limit}\u00a0mm`,
      unlimited: (bound: string) => `position error at most ${bound}\u00a0mm (95\u00a0%), no limit was given`,
      sized: (effect: string, size: string) => `${effect}, ${size}`,
      notIdentified: "no robot within its tolerances gives these readings",
      undecided: (cause: string, percent: string, others: string) => `${cause} (${percent} %) or ${others}`,
    },
    wantedNone:
      "No accuracy was wanted: neither the request nor the robot file gives one, and the fit alone decides.",
    wantedIs: (mm: string) =>
      `Wanted accuracy: ${mm} mm. The 95 % bound of the position error is compared with it, not the estimate.`,

    nextStep: "Next step",
    consequences: {
      apply: ", and its drives receive new zeros.",
      roll_back: ", and its drives receive their old zeros.",
      start: " over its whole workspace.",
      separate: " over its workspace.",
      resume: " over its workspace.",
    },
    /** By the purpose of the step. */
    next: {
      watch: { button: "Show the run", text: "The run is in progress." },
      answer: { button: "Answer the question", text: "The run waits for an answer at the station." },
      apply: {
        button: "Apply to drives",
        text: "Write the zero offsets to the drives. Fresh readings then verify them.",
      },
      roll_back: {
        button: "Roll back",
        text: "The state of the drives is not as intended. Restore the old zero offsets.",
      },
      not_applicable: { text: "The zero offsets cannot be applied." },
      applied: { text: "Nothing to do. The drives hold these zero offsets." },
      produce: { text: "Nothing to do. The robot may be used as it is." },
      applied_there: { button: "Show the calibration", text: "The drives hold the new zero offsets." },
      back: { button: "Show the calibration", text: "This run belongs to an earlier one. Continue there." },
      again: { button: "Measure again", text: "Remove the cause, then measure again." },
      again_there: {
        button: "Go to the station",
        text: "Remove the cause, then start again at the station.",
      },
      resume: {
        button: "Go on with the study",
        text: "The mountings that were finished are kept. Go on with the next one.",
      },
      gauge: { text: "Nothing to do. The report below shows what the scatter comes from." },
      inside: { button: "Go to the station", text: "Calibrate the robot." },
      look: { text: "Read the reason above." },
      recalibrate: {
        button: "Calibrate again",
        text: "The drives do not hold these zero offsets. Calibrate again.",
      },
      too_coarse: {
        button: "Calibrate with plan full",
        text: "The steps of the readout are too coarse for this plan.",
      },
      apply_known: {
        button: "Go to that result",
        text: "A newer calibration has found this shift, but the drives hold the old zero offsets. Apply it.",
      },
      shifted: { button: "Calibrate again", text: "The zeros have shifted since the last calibration." },
      calibrate: {
        button: "Calibrate",
        text: "A diagnosis writes nothing to the drives. Calibrate to have zero offsets that can be applied.",
      },
      find_cause: {
        button: "Find the cause",
        text: "An effect is missing from the model. 120 readings show what the residual depends on; 40 fresh readings check the cause found.",
      },
      decide: {
        button: "Start the deciding experiment",
        text: "Further readings distinguish the possible causes.",
      },
      decide_by_plan: {
        button: "Prepare the experiment",
        text: "The station shows the start form with this robot and the plan of the experiment.",
      },
      decide_by_hand: {
        button: "Show the experiments",
        text: "An experiment by hand distinguishes the possible causes.",
      },
      repaired: {
        button: "Repaired: measure again",
        text: "Repair the cause. Then measure again: the run shows whether it is removed.",
      },
      raise: {
        button: "Raise the accuracy",
        text: "This raises the accuracy as required, or most for the time it takes.",
      },
      raise_by_hand: {
        button: "Go to the station",
        text: "This raises the accuracy as required, or most for the time it takes. Enter the value as a reference when you start.",
      },
      no_advice: {
        text: "No further measurement raises the accuracy noticeably. A wider limit or a better scale is necessary.",
      },
      see: { button: "Show the diagnosis", text: "The diagnosis shows what the residual depends on." },
    },
    /** By its kind, with the joint if it concerns one. */
    adviceByKind: {
      repeat: () => "Measure the same readings once more.",
      joint_angle: (joint: string) => `Read the angle of joint ${joint} from a level.`,
      drm_x: () => "Measure the sideways mounting error of the mechanism.",
      second_mount: () => "Measure from a second mounting point.",
    } as Record<string, (joint: string) => string>,
    advised: (text: string, gain: string, time: string) =>
      `${text} The bound falls by ${gain} mm; it takes about ${time}.`,
    advice: "What would raise the accuracy",
    gain: "Gain, mm",
    time: "Time",

    map: {
      title: "Position error over the workspace",
      before: "Before: expected error",
      after: "After: error at most (95 %)",
      how: "Tap a position, or use the arrow keys, to read its values",
      unit: "mm",
      scale: (low: string, high: string) => `Colour scale from ${low} mm (dark) to ${high} mm (light)`,
      limitMark: (mm: string) => `limit ${mm}`,
      value: (x: string, y: string, before: string, bound: string, expected: string) =>
        `x ${x} mm, y ${y} mm: before ${before} mm; after at most ${bound} mm (95 %), expected ${expected} mm.`,
      closed: (x: string, y: string) => `x ${x} mm, y ${y} mm: outside the limits of the joints.`,
      noLimit: "No limit was given.",
      notValid:
        "Not valid: this run was not accepted. The map shows what its explanation of the readings expects.",
      limit: {
        everywhere: (mm: string) => `After: the limit of ${mm} mm is kept everywhere.`,
        partly: (mm: string) => `After: the line is the limit of ${mm} mm; beyond it the limit is not kept.`,
        nowhere: (mm: string) => `After: the limit of ${mm} mm is kept nowhere.`,
      },
      fresh: (count: number, rms: string, largest: string) =>
        `Dots: ${count} fresh readings, residual ${rms} µm RMS, largest ${largest} µm.`,
      noFresh: "No fresh readings: each reading was predicted before it was used.",
    },

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
    rollBack: "Roll back",
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
    translate: {
      title: "Taught positions",
      note: "Joint positions that were taught under the zero offsets before this run become the same physical positions under those in the drives.",
      positions:
        "Positions, one a line: name, θ₁ and θ₂ in degrees; or a CSV file, or a program in KRL or RAPID",
      back: "Back: they were translated before",
      button: "Translate",
      none: "Type or paste the positions.",
      wrong: (line: number) => `Line ${line} is not a name with two numbers.`,
      uncertainty: "U (95 %), mm",
      limits: "Limits",
      within: "within",
      near: "◆ near a limit",
      save: "Save the positions (CSV)",
      file: (id: number) => `taught-run-${id}.csv`,
      saveProgram: "Save the program",
      programFile: (id: number) => `taught-run-${id}.txt`,
    },
    promised: "Promised accuracy",
    bound: (drives: string, model: string) =>
      `With 95 % probability no position error is above ${drives} mm with these zeros in the drives, ${model} mm with commands of the model.`,
    wanted: (mm: string) => `${mm} mm are wanted.`,
    stopped: (why: string) => (why ? `No further readings: ${why}.` : ""),
    smallestShift: (deg: string, blind: string, blindDeg: string) =>
      `A shift of either zero by ${deg}° is found with 99 % probability; of ${blind} by ${blindDeg}°.`,
    fleetUsed: (count: number, type: string, serials: string, p: string) =>
      `Used: geometry of ${count} other robots of type ${type} (${serials}; p-value ${p}).`,
    fleetNotUsed: (type: string, serials: string, p: string) =>
      `◆ Not used: this robot is not like the others of type ${type} (${serials}; p-value ${p}). Check its type and its lengths.`,
    memoryNone: "This run used no stored parameters.",
    memoryNext: (id: number, days: string) =>
      `The next rapid or full run starts from run ${id}, which is ${days} days old.`,
    memoryNextNone: "The next run starts without stored parameters.",
    forget: "Delete",
    forgetWarning: (serial: string) => `The next run of robot ${serial} will start `,
    forgetEmphasis: "without stored parameters",
    forgetAs: ". This is necessary after the mechanism was remounted.",

    checkModel: "Check the model for missing effects",
    misfit: "◆ The model does not fit these readings",
    misfitOffsets:
      "An effect is missing from the model. The zero offsets may be in error by more than their uncertainty.",
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
    bound: "Position error, 95 % bound, mm",
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
    possible: "Possible causes",
    tried: "Effects tested; none of them is the cause",
    noEffect: "The model contains no effect of the catalogue.",
    effect: (rank: number) => `Effect ${rank}`,
    size: "Size ± U",
    share: "Share of the residual",
    probability: "Probability",
    alternatives: "Alternative explanations",
    noAlternative: "no other effect of the catalogue",
    remedy: "Remedy",
    toDistinguish: (experiment: string) => `To distinguish the alternatives: ${experiment}`,
    meaning: "Meaning of the parameters",

    explanations: "Explanations",
    explanationsTitle: "Explanations of the readings, most probable first",
    explanationSized: "Explanation, size ± U",
    noError: "No error: the base model alone",
    outsideCatalogue: "not in the catalogue",

    experiments: "Experiments",
    experimentsTitle: "Experiments that can decide, best first",
    experiment: "Experiment",
    decides: "Probability to decide",

    mistake: "Mistake in the data",
    mistakeTitle: "◆ Mistake in the data",
    mistakeRows: (rows: string) => `Rows of the file: ${rows}.`,
    mistakeRow: (row: string) => `Row of the file: ${row}.`,
    rowsTo: (first: number, last: number) => `${first} to ${last}`,

    hints: "Hints",
    hintsTitle: "What the remaining residual depends on",
    hint: (text: string, percent: string) => `${text} (${percent} %)`,

    distinguish: "Distinguish the alternative explanations",
    planning: "Planning …",
    moreReadings: (count: number) =>
      `${count} more readings, at the positions where the models differ most, should distinguish the effect found from `,
    freshReadings: (count: number, duration: string) =>
      `. Then ${count} fresh readings check the result. Duration: about ${duration}.`,
    continues:
      "The further diagnosis continues this run. Until then, do not change scale, drives or mechanism.",
    runSeparating: "Start the further diagnosis",
    workspace: " over its workspace.",
    planned: (count: number, left: string, right: string, bottom: string, top: string) =>
      `${count} planned positions, x from ${left} to ${right} mm, y from ${bottom} to ${top} mm`,

    residual: "Residual",
    residualTitle: "Residual of each reading",
    orderBy: "Order the residual by",
    how: "Tap a reading, or move through the readings with the arrow keys",
    zoom: "Zoom",
    zoomIn: "Zoom in",
    zoomOut: "Zoom out",
    zoomAll: "Show all",
    savePicture: (title: string) => `Save “${title}” as picture`,
    pictureName: (id: number, by: string, title: string) => `run-${id}-${by}-${title.toLowerCase()}.svg`,
    readingAt: (reading: string, position: string) => `Reading ${reading} at position ${position}`,
    valueBefore: (um: string) => `before ${um} µm`,
    valueOf: (name: string, um: string) => `${name} ${um} µm`,
    valueAfter: (um: string, limit: string) => `after ${um} µm (limit ${limit} µm)`,

    use: "Use the result",
    takeModel: "Save the model (JSON)",
    takeModelNote:
      "The command line computes with it away from the station: station solve --model FILE TARGETS.csv.",
    modelName: (id: number) => `model-of-run-${id}.json`,
    targets:
      "Targets, one per line: x and y in mm; then, if the model needs it, the approach of joints 1 and 2 (-1 from above, 1 from below)",
    noTarget: "Give at least one target.",
    wrongTarget: (line: number) =>
      `Line ${line} is no target: give x and y in mm, and -1, 0 or 1 for both approaches or for neither.`,
    compute: "Compute joint commands",
    command: (joint: number) => `Joint ${joint}, °`,
    refuted: "◆ Fresh readings contradict this model.",
    saveCommands: "Save the commands (CSV)",
    commandsName: (id: number) => `commands-of-run-${id}.csv`,
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

  maintenance,
  training,

  history: {
    title: "History",
    runs: "Runs",
    run: "Run",
    started: "Started",
    robot: "Robot",
    outcome: "Outcome and reason",
    offset: (joint: number) => `Offset ${joint} ± U, °`,
    offsets: "Offsets 1 and 2 ± U, °",
    readings: "Readings",
    csv: "CSV",
    csvLabel: (id: number) => `Readings of run ${id}, CSV`,
    kindOf: (kind: string, of: number) => `${kind} (run ${of})`,
    noMatch: "No run matches.",
    trouble: (text: string) => `▲ ${text}`,
    firstPage: "First page",
    nextPage: "Next page",
    workOrder: "Work order",
    found: (count: number, more: boolean) =>
      more ? `More than ${count} runs` : count === 1 ? "1 run" : `${count} runs`,
    listCsv: "List (CSV)",
    compare: "Compare",
    compareWith: "Compare",
    compareLabel: (id: number) => `Compare run ${id}`,
    comparison: "Two runs compared",
    chooseSecond: (id: string) => `Run ${id} is chosen. Choose a second run in the list.`,
    mapDifference: (b: number, a: number) => `Position error, 95 % bound: run ${b} less run ${a}`,
    largestDifference: (mm: string) => `Largest difference: ${mm} mm. Light: the second run leaves more.`,
    otherWorkspace: "The workspaces of the two runs differ: their maps cannot be compared.",
    version: (version: string) => `version ${version}`,
    endComparison: "End comparison",
    quantity: "Quantity",
    runOf: (id: number, serial: string) => `Run ${id}, ${serial}`,
    difference: "Second less first",
    residualsOf: (id: number) => `Residual of each reading, run ${id}`,
    residualRms: "Residual, RMS, µm",
    residualMax: "Residual, largest, µm",
    process: "Process",
    processOf: (serial: string) => `Process: robot ${serial}`,
    processOfType: (type: string) => `Process: robots of type ${type}`,
    processOfAll: "Process: all robots of this station",
    pareto: (runs: number) => `What the newest ${runs} calibrations ended with`,
    share: "Share of all",
    offsetTrend: (joint: number) => `Zero offset of joint ${joint}`,
    effectTrend: (effect: string, size: string) => `${effect}: ${size}`,
    errorTrend: "Largest position error (95 % bound)",
    trendChart: (name: string) => `${name} of each run with its limits, and its change from run to run`,
    fewValues: "Limits need three runs or more.",
    limits: (low: string, high: string, unit: string) =>
      `Limits of the individual values: ${low} to ${high} ${unit}.`,
    noRule: "No rule is broken.",
    atRuns: (runs: string) => `run ${runs}`,
    runAxis: "run",
    rangeAxis: (unit: string) => `moving range, ${unit}`,
    marks: { apply: "applied", rollback: "rolled back", mount: "mounted anew" },
    /** Nelson's rules. */
    rules: {
      nelson_1: "one value beyond three standard deviations",
      nelson_2: "nine values in a row on one side of the mean",
      nelson_3: "six values in a row rising, or falling",
      nelson_4: "fourteen values in a row up and down in turn",
      nelson_5: "two of three values beyond two standard deviations on one side",
      nelson_6: "four of five values beyond one standard deviation on one side",
      nelson_7: "fifteen values in a row within one standard deviation",
      nelson_8: "eight values in a row beyond one standard deviation on both sides",
    },
    filter: "Filter",
    type: "Robot type",
    serial: "Robot serial",
    state: "State",
    verdict: "Verdict",
    from: "From",
    to: "To",
    all: "all",
  },
};
