"""The true position error, where a tracker measured the position of P beside the distance."""

from __future__ import annotations

import numpy as np

from station.diagnosis.explanations import Around, ExplanationSet
from station.fitting import rms_and_max
from station.mechanism import temperature_rise
from station.model import Fit, Situation, identified
from station.records import Measurements, PositionError


def true_position_errors(
    base: Fit, last: Fit, sequence: Measurements, fresh: Measurements | None
) -> tuple[PositionError, PositionError] | None:
    """The position of P by the models against the tracker, before and after; None without a tracker.

    Fresh readings are used, or without tracked ones the sequence. The tracker is not used in any fit; its
    frame is the robot's.
    """
    tracked = next((m for m in (fresh, sequence) if m is not None and m.tracker is not None), None)
    machines = identified(base), identified(last)
    if tracked is None or machines[0] is None or machines[1] is None:
        return None
    rise = temperature_rise(tracked, last.model.reference)
    nothing = np.zeros(len(tracked))
    situation = Situation(
        tracked.approach.astype(float),
        nothing if rise is None else rise,
        nothing if tracked.payload_kg is None else tracked.payload_kg,
    )
    assert tracked.tracker is not None
    stood = tracked.tracker @ [1.0, 1.0j]
    before, after = (
        np.abs(machine.positions(tracked.theta, situation) - stood) for machine in machines if machine
    )
    return rms_and_max(before), rms_and_max(after)


def true_errors_of_set(
    found: ExplanationSet, sequence: Measurements, fresh: Measurements | None
) -> tuple[PositionError, PositionError] | None:
    """The same under the base model and under a set of explanations."""
    tracked = next((m for m in (fresh, sequence) if m is not None and m.tracker is not None), None)
    if tracked is None or tracked.tracker is None:
        return None
    around = Around(
        tracked.approach.astype(float),
        temperature_rise(tracked, found.weighing.reference),
        tracked.payload_kg,
    )
    stood = tracked.tracker @ [1.0, 1.0j]
    before, after = (
        np.abs(mixture.positions(tracked.theta, around) - stood)
        for mixture in (found.mixture.only(found.base), found.mixture)
    )
    return rms_and_max(before), rms_and_max(after)
