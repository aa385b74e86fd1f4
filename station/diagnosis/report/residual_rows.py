"""The residual of every reading, model by model, with all quantities it may be ordered by: data of charts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from station.diagnosis.report.findings import Findings


@dataclass(frozen=True, slots=True)
class ResidualRow:
    """One reading that was used."""

    reading: int | str
    position: str
    x_mm: float
    """Position of P by the base model."""
    y_mm: float
    t_s: float
    theta1_deg: float
    """Actual joint angle, zero offset included."""
    theta2_deg: float
    approach1: int
    approach2: int
    travel_mm: float
    temperature_rise_k: float | None
    before_mm: float
    """Measured less base model."""
    by_effect_mm: tuple[float, ...]
    """Contribution of each effect, in the order in which they were added."""
    after_mm: float
    """Residual of the last model."""
    limit_mm: float
    """Limit that noise alone hardly exceeds."""


@dataclass(frozen=True, slots=True)
class Residuals:
    """The residuals of the readings learned on."""

    effects: tuple[str, ...]
    """Labels, in the order in which they were added."""
    rows: tuple[ResidualRow, ...]


def residuals(findings: Findings, positions: Mapping[int | str, str]) -> Residuals:
    """Row by row; `positions` gives the position label of each reading."""
    m, view = findings.measurements, findings.residual
    theta, rise = np.degrees(view.theta), view.temperature_rise_k
    return Residuals(
        findings.added,
        tuple(
            ResidualRow(
                reading=m.ids[k],
                position=positions[m.ids[k]],
                x_mm=float(view.place_mm[k, 0]),
                y_mm=float(view.place_mm[k, 1]),
                t_s=float(m.t_s[k]),
                theta1_deg=float(theta[k, 0]),
                theta2_deg=float(theta[k, 1]),
                approach1=int(m.approach[k, 0]),
                approach2=int(m.approach[k, 1]),
                travel_mm=float(view.travel_mm[k]),
                temperature_rise_k=None if rise is None else float(rise[k]),
                before_mm=float(view.before_mm[k]),
                by_effect_mm=tuple(float(taken[k]) for taken in view.by_effect_mm),
                after_mm=float(view.after_mm[k]),
                limit_mm=float(view.limit_mm[k]),
            )
            for k in range(len(m))
        ),
    )
