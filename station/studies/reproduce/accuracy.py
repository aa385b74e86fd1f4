"""The largest position error over the workspace of each method, group and kind of machine, with its bound."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from station.studies.reproduce.statistics import median_error, spread
from station.studies.reproduce.trial import (
    FULL,
    FULL_DRM,
    PAPER,
    RAPID_DRM,
    RAPID_MEMORY,
    Conditions,
    Outcome,
)

TARGETS_MM = {FULL: (0.20, 0.13), RAPID_MEMORY: (0.18, 0.13), FULL_DRM: (0.10, 0.06), RAPID_DRM: (0.10, 0.06)}
"""Of the median, groups 1 to 3 and 4 to 6."""

Row = dict[str, Any]


def accuracy(
    trials: Mapping[Conditions, Mapping[str, Sequence[Outcome]]],
    bounds: Mapping[Conditions, Mapping[str, float]],
) -> list[Row]:
    """[{group, servo, samples, variant, workspace_mm: spread, median_error_mm, bound_mm, ratio, target_mm}]

    ratio is median over bound; median_error_mm the standard error that so many seeds leave.
    """
    rows = []
    for conditions, outcomes in trials.items():
        for variant, runs in outcomes.items():
            values = [run.workspace_mm for run in runs]
            bound = bounds[conditions].get(variant)
            target = TARGETS_MM.get(variant)
            rows.append(
                {
                    "group": conditions.group,
                    "servo": conditions.servo,
                    "samples": conditions.samples,
                    "variant": variant,
                    "method": "paper" if variant.startswith(PAPER) else "ours",
                    "workspace_mm": spread(values),
                    "median_error_mm": median_error(values),
                    "bound_mm": bound,
                    "ratio": None if bound is None else float(np.median(values)) / bound,
                    "target_mm": target[0 if conditions.group <= 3 else 1] if target else None,
                }
            )
    return rows
