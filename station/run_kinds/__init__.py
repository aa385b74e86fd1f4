"""The kinds of runs, one per module. Importing the package registers all of them."""

from __future__ import annotations

from station.run_kinds import (  # noqa: F401 - they register themselves
    apply,
    calibrate,
    diagnose,
    gauge_study,
    import_file,
    retract,
    separate,
)
from station.run_kinds.adaptive import adaptive_run, fit_in_sequence, memory_test
from station.run_kinds.arm_log import ArmLog, Sent, import_log, import_measured
from station.run_kinds.calibrate import measured_and_verified
from station.run_kinds.check import check_run
from station.run_kinds.diagnose import diagnosed, diagnostic
from station.run_kinds.error_maps import error_map
from station.run_kinds.gauge_evaluation import JointStudied, StationGauge, station_gauge
from station.run_kinds.gauge_report import gauge_page, judgement
from station.run_kinds.import_file import Upload, import_dataset
from station.run_kinds.kind import RUN_KINDS, Continued, RunKind, Start, kind_of_plan, request_of
from station.run_kinds.lock import calibration_holds, check_not_locked, clear_failed_check
from station.run_kinds.separate import planned
from station.run_kinds.translate import Change, change_of, translated
from station.run_kinds.zero_state import application

__all__ = [
    "RUN_KINDS",
    "ArmLog",
    "Change",
    "Continued",
    "JointStudied",
    "RunKind",
    "Sent",
    "Start",
    "StationGauge",
    "Upload",
    "adaptive_run",
    "application",
    "calibration_holds",
    "change_of",
    "check_not_locked",
    "check_run",
    "clear_failed_check",
    "diagnosed",
    "diagnostic",
    "error_map",
    "fit_in_sequence",
    "gauge_page",
    "import_dataset",
    "import_log",
    "import_measured",
    "judgement",
    "kind_of_plan",
    "measured_and_verified",
    "memory_test",
    "planned",
    "request_of",
    "station_gauge",
    "translated",
]
