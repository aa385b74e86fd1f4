"""The report of a diagnosis: its document, its page and the figures in both."""

from __future__ import annotations

from station.diagnosis.report.findings import Findings, FoundEffect
from station.diagnosis.report.joint_curves import Curve, curves
from station.diagnosis.report.of_diagnosis import findings_of
from station.diagnosis.report.report_charts import curve_chart
from station.diagnosis.report.report_page import page, run_source, shown
from station.diagnosis.report.residual_rows import residuals
from station.diagnosis.report.stages import kept_fresh
from station.diagnosis.report.traced_findings import TracedFindings
from station.diagnosis.report.weighed_findings import WeighedFindings
from station.diagnosis.report.wording import stage_name

__all__ = [
    "Curve",
    "Findings",
    "FoundEffect",
    "TracedFindings",
    "WeighedFindings",
    "curve_chart",
    "curves",
    "findings_of",
    "kept_fresh",
    "page",
    "residuals",
    "run_source",
    "shown",
    "stage_name",
]
