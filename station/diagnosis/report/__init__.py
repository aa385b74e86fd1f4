"""What is reported of a diagnosis: its document, its page and the figures in both."""

from __future__ import annotations

from station.diagnosis.report.document import Findings
from station.diagnosis.report.joint_curves import Curve, curves
from station.diagnosis.report.report_page import curve_chart, page, shown
from station.diagnosis.report.residual_rows import residuals
from station.diagnosis.report.stages import kept_fresh

__all__ = [
    "Curve",
    "Findings",
    "curve_chart",
    "curves",
    "kept_fresh",
    "page",
    "residuals",
    "shown",
]
