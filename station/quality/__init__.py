"""Is the process capable, and is the gauge?"""

from __future__ import annotations

from station.quality.control_chart import RULE_TEXTS
from station.quality.crossed_anova import GaugeStudy, gauge_study
from station.quality.process import Figure, Quality, Trend, quality, trend

__all__ = [
    "RULE_TEXTS",
    "Figure",
    "GaugeStudy",
    "Quality",
    "Trend",
    "gauge_study",
    "quality",
    "trend",
]
