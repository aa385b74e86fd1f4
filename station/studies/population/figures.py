"""What a population shows, as figures; every share with its 95 % interval (Wilson)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from scipy.stats import binomtest

from station.five_bar import NAMES
from station.quality import K95, Limits, cpk, ppk
from station.settings import QualitySettings
from station.studies.population.one import Calibrated, quantiles

Figures = dict[str, Any]
_DIGITS = 9
"""Significant ones of a figure: more differ from one processor to another."""


def accuracy(found: Sequence[Calibrated]) -> Figures:
    """How far off zeros and positions are after a calibration."""
    zeros_deg = np.degrees(np.abs([one.zero_error for one in found]).max(axis=1))
    return {
        "machines": len(found),
        "passed": _share([one.passed for one in found]),
        "zero_offset_error_deg": quantiles(zeros_deg),
        "largest_position_error_mm": quantiles([one.largest_mm for one in found]),
        "bound_95_mm": quantiles([one.bound_mm for one in found]),
        "largest_position_error_by_model_mm": quantiles([one.by_model_mm for one in found]),
        "bound_95_by_model_mm": quantiles([one.bound_by_model_mm for one in found]),
    }


def coverage(found: Sequence[Calibrated]) -> Figures:
    """Whether stated uncertainties hold: 95 % of what they say should lie inside."""
    off = np.abs([one.off_sd for one in found])
    return {
        "machines": len(found),
        "inside_95": {name: _share(off[:, k] <= K95) for k, name in enumerate(NAMES)},
        "bound_95_holds": _share([one.largest_mm <= one.bound_mm for one in found]),
        "bound_95_by_model_holds": _share([one.by_model_mm <= one.bound_by_model_mm for one in found]),
        "refused_though_good": _share([not one.passed for one in found]),
    }


def capability(found: Sequence[Calibrated]) -> Figures:
    """Of the process that a population is: zero offsets found, and position errors left."""
    limits = QualitySettings()
    series = {
        **{
            f"dtheta{k + 1}_deg": (
                np.degrees([one.zero_offset[k] for one in found]),
                Limits(-limits.zero_offset_deg, limits.zero_offset_deg),
            )
            for k in range(2)
        },
        "position_error_mm": (
            np.array([one.largest_mm for one in found]), Limits(None, limits.position_error_mm)
        ),
    }  # fmt: skip
    out: Figures = {"machines": len(found)}
    for name, (values, within) in series.items():
        short, long = cpk(values, within), ppk(values, within)
        out[name] = {
            "mean": float(values.mean()),
            "sd": float(values.std(ddof=1)) if len(values) > 1 else None,
            "cpk": short and [short.value, short.low, short.high],
            "ppk": long and [long.value, long.low, long.high],
        }
    return out


FIGURES: Mapping[str, Callable[[Sequence[Calibrated]], Figures]] = {
    "accuracy": lambda found: _rounded(accuracy(found)),
    "coverage": lambda found: _rounded(coverage(found)),
    "capability": lambda found: _rounded(capability(found)),
}


def _share(which: Sequence[bool] | Any) -> Figures:
    count, total = int(np.sum(which)), len(which)
    interval = binomtest(count, total).proportion_ci(0.95, method="wilson")
    return {"share": count / total, "low": float(interval.low), "high": float(interval.high)}


def _rounded(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _rounded(part) for key, part in value.items()}
    if isinstance(value, list):
        return [_rounded(part) for part in value]
    return float(f"{value:.{_DIGITS}g}") if isinstance(value, float) else value
