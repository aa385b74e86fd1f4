"""The search for causes: scan of the catalogue, the loop that adds effects, and dependences of a residual."""

from __future__ import annotations

from station.diagnosis.search.cause_search import ALIAS, SIGNIFICANT, Stage, Trace, trace, with_alias
from station.diagnosis.search.dependence import Hint, hints
from station.diagnosis.search.far_off import gross_readings
from station.diagnosis.search.long_log_search import long_trace
from station.diagnosis.search.scan import INVISIBLE_SHARE, Scan

__all__ = [
    "ALIAS",
    "INVISIBLE_SHARE",
    "SIGNIFICANT",
    "Hint",
    "Scan",
    "Stage",
    "Trace",
    "gross_readings",
    "hints",
    "long_trace",
    "trace",
    "with_alias",
]
