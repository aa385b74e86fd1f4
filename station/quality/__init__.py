"""Capability of the process and of the gauge."""

from __future__ import annotations

from station.quality.capability import K95, Limits, cpk, ppk
from station.quality.control_chart import RULE_TEXTS
from station.quality.crossed_anova import GaugeStudy, gauge_study
from station.quality.parquet import Exported, export_parquet
from station.quality.process import Figure, Quality, Trend, quality, trend
from station.quality.station_study import JointGauge, gauge_sd, joint_gauge

__all__ = [
    "K95",
    "RULE_TEXTS",
    "Exported",
    "Figure",
    "GaugeStudy",
    "JointGauge",
    "Limits",
    "Quality",
    "Trend",
    "cpk",
    "export_parquet",
    "gauge_sd",
    "gauge_study",
    "joint_gauge",
    "ppk",
    "quality",
    "trend",
]
