"""The paper's tables beside ours."""

from __future__ import annotations

from station.studies.reproduce.page import make_page
from station.studies.reproduce.printed import true_errors
from station.studies.reproduce.study import run_study

__all__ = [
    "make_page",
    "run_study",
    "true_errors",
]
