"""Is the process capable, and is the gauge?"""

from __future__ import annotations

from station.quality.control_chart import RULE_TEXTS
from station.quality.crossed_anova import GaugeStudy, gauge_study
from station.quality.parquet import Exported, export_parquet
from station.quality.process import Figure, Quality, Trend, quality, trend

__all__ = [
    "RULE_TEXTS",
    "Exported",
    "Figure",
    "GaugeStudy",
    "Quality",
    "Trend",
    "export_parquet",
    "gauge_study",
    "quality",
    "trend",
]
