"""The findings of a diagnosis, whichever search made it."""

from __future__ import annotations

from station.diagnosis.closed_loop import AnyDiagnosis
from station.diagnosis.report.findings import Findings
from station.diagnosis.report.traced_findings import TracedFindings
from station.diagnosis.report.weighed_findings import WeighedFindings
from station.diagnosis.weighed_loop import WeighedDiagnosis


def findings_of(diagnosis: AnyDiagnosis) -> Findings:
    """All results of the diagnosis."""
    if isinstance(diagnosis, WeighedDiagnosis):
        return WeighedFindings(diagnosis)
    return TracedFindings(diagnosis)
