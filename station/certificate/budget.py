"""The uncertainty budget of a scale reading, with each contribution after the GUM (GUM, 4 and 5.1).

The identification propagates the scatter of the readings, and the tolerances of geometry and mounting, to the
zero offsets; this table states the quality of the readings that it uses.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Literal

import numpy as np

from station.records import Reading, Record, ScaleCertificate, readout_step_mm

Distribution = Literal["normal", "uniform"]
_UM = 1000.0
_REFERENCE_C = 20.0
"""Standard reference temperature of lengths (ISO 1)."""


class Contribution(Record):
    """One line of the budget, in um."""

    source: Literal[
        "repeatability", "resolution", "scale_calibration", "scale_temperature", "temperature_correction"
    ]
    evaluation: Literal["A", "B"]
    distribution: Distribution
    standard_um: float
    """Standard uncertainty; for the correction to 20 degrees, which is not applied, its size."""
    detail: dict[str, float]
    """The data it was computed from."""


def reading_budget(readings: Sequence[Reading], scale: ScaleCertificate | None) -> tuple[Contribution, ...]:
    """The budget of one reading over the travel used; empty without readings.

    :param scale: None: only contributions shown by the readings are stated
    """
    if not readings:
        return ()
    lengths = np.array([reading.scale_mm for reading in readings])
    travel_mm = float(np.ptp(lengths))
    out = [*_repeatability(readings), *_resolution(readings)]
    if scale is None:
        return tuple(out)
    calibration_um = (scale.u95_um + scale.u95_um_per_m * travel_mm / _UM) / 2
    measured_c = [reading.temperature_c for reading in readings if reading.temperature_c is not None]
    at_c = float(np.mean(measured_c)) if measured_c else scale.temperature_c
    um_per_k = scale.expansion_ppm_per_k * travel_mm / _UM
    length = {"travel_mm": round(travel_mm, 3)}
    thermal = {**length, "ppm_per_k": scale.expansion_ppm_per_k, "at_c": round(at_c, 2)}
    return (
        *out,
        Contribution(
            source="scale_calibration", evaluation="B", distribution="normal",
            standard_um=calibration_um, detail=length,
        ),
        Contribution(
            source="scale_temperature", evaluation="B", distribution="uniform",
            standard_um=um_per_k * scale.temperature_within_k / math.sqrt(3),
            detail={**thermal, "within_k": scale.temperature_within_k},
        ),
        Contribution(
            source="temperature_correction", evaluation="B", distribution="uniform",
            standard_um=abs(um_per_k * (at_c - _REFERENCE_C)), detail=thermal,
        ),
    )  # fmt: skip


def _repeatability(readings: Sequence[Reading]) -> list[Contribution]:
    """Pooled over the readings: the samples of each were taken at standstill (GUM, 4.2.4)."""
    several = [np.array(reading.samples_mm) for reading in readings if len(reading.samples_mm) > 1]
    if not several:
        return []
    dof = sum(len(samples) - 1 for samples in several)
    variance = sum(float(np.sum((samples - samples.mean()) ** 2)) for samples in several) / dof
    per_reading = float(np.mean([len(samples) for samples in several]))
    return [
        Contribution(
            source="repeatability",
            evaluation="A",
            distribution="normal",
            standard_um=_UM * math.sqrt(variance / per_reading),
            detail={"samples": round(per_reading, 2), "dof": dof},
        )
    ]


def _resolution(readings: Sequence[Reading]) -> list[Contribution]:
    """Half a step to either side, every value equally likely (GUM, F.2.2.1)."""
    step_mm = readout_step_mm(sample for reading in readings for sample in reading.samples_mm)
    if step_mm == 0.0:
        return []
    return [
        Contribution(
            source="resolution",
            evaluation="B",
            distribution="uniform",
            standard_um=_UM * step_mm / math.sqrt(12),
            detail={"step_um": round(_UM * step_mm, 4)},
        )
    ]
