"""Predicted and observed shares of experiments that decided."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from pydantic import JsonValue

from station.diagnosis import Trial

EDGES = (0.0, 0.1, 0.3, 0.6, 0.9, 1.0)


def figures(machines: Sequence[Sequence[Trial]]) -> dict[str, JsonValue]:
    """By kind of experiment: all, and in classes of the predicted probability."""
    everything = [one for tried in machines for one in tried]
    kinds = sorted({one.kind for one in everything})
    return {
        "machines": len(machines),
        "questions": sum(bool(tried) for tried in machines),
        "experiments": {kind: _row([one for one in everything if one.kind == kind]) for kind in kinds},
    }


def _row(tried: Sequence[Trial]) -> dict[str, JsonValue]:
    number = np.digitize([one.predicted for one in tried], EDGES[1:-1])
    classes = ([one for one, at in zip(tried, number, strict=True) if at == k] for k in range(len(EDGES) - 1))
    return {**_shares(tried), "by_prediction": [_shares(some) for some in classes if some]}


def _shares(tried: Sequence[Trial]) -> dict[str, JsonValue]:
    return {
        "machines": len(tried),
        "predicted": round(float(np.mean([one.predicted for one in tried])), 3),
        "observed": round(float(np.mean([one.decided for one in tried])), 3),
    }
