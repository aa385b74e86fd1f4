"""What a run can do, one kind a module."""

from __future__ import annotations

from station.run_kinds.apply import start_application
from station.run_kinds.calibrate import start_procedure
from station.run_kinds.diagnose import diagnosed
from station.run_kinds.import_file import Upload, import_dataset
from station.run_kinds.separate import check_separating, learned, planned, since_start_s, start_separating

__all__ = [
    "Upload",
    "check_separating",
    "diagnosed",
    "import_dataset",
    "learned",
    "planned",
    "since_start_s",
    "start_application",
    "start_procedure",
    "start_separating",
]
