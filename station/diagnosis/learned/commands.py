"""Joint commands for target positions under an identified model, including every effect on the position."""

from __future__ import annotations

import numpy as np

from station.diagnosis.learned.acting import Acting
from station.diagnosis.learned.model_file import LearnedModel
from station.diagnosis.learned.targets import APPROACH, Targets
from station.five_bar import Unreachable
from station.model import NotInvertible, Situation
from station.records import Phrase, Real, phrase

EDGE = 0.05
"""Share of the learned joint range by which a command may exceed it: the sequence was commanded before the
zero offsets were known, so it differs from the workspace's joint range by that much.
"""


def solve_targets(model: LearnedModel, targets: Targets) -> Real:
    """(K, 2) joint commands, rad in the drives' nominal frame.

    :raises InputRefused: a target is out of reach or outside the range on which the effects were learned, or
    lacks the approach, temperature or payload that an effect needs; the error gives row and column.
    """
    machine = model.machine
    for effect in model.acting:
        _check_given(effect, targets)
    count = len(targets)
    rise: Real = np.zeros(count)
    if targets.temperature_c is not None and model.temperature_c is not None:
        rise = targets.temperature_c - model.temperature_c
    payload = np.zeros(count) if targets.payload_kg is None else targets.payload_kg
    try:
        theta = machine.commands(targets.place, Situation(targets.approach, rise, payload))
    except Unreachable as error:
        k = int(error.indices[0])
        at = targets.place[k]
        why = phrase("target_out_of_reach", x_mm=float(at.real), y_mm=float(at.imag))
        raise targets.refusal(k, "x_mm, y_mm", why) from error
    except NotInvertible as error:
        why = phrase("no_command_found", why=error.said)
        raise targets.refusal(0, "x_mm, y_mm", why) from error
    _check_range(model, theta, targets)
    return theta


def _check_given(effect: Acting, targets: Targets) -> None:
    """Refuse an effect that depends on a quantity the file does not contain: it cannot be compensated."""
    if effect.by_payload and targets.payload_kg is None:
        raise targets.refusal(0, "payload_kg", phrase("learned_with_payloads", causes=effect.label))
    for joint in effect.by_approach:
        missing = np.flatnonzero(targets.approach[:, joint - 1] == 0)
        if missing.size:
            why = phrase("depends_on_approach", causes=effect.label)
            raise targets.refusal(int(missing[0]), APPROACH[joint - 1], why)


def _check_range(model: LearnedModel, theta: Real, targets: Targets) -> None:
    """Refuse targets outside the range of a joint on which its effects were learned."""
    degrees = np.degrees(theta)
    for effect in model.acting:
        for joint in effect.joints:
            i = joint - 1
            low, high = model.joint_range_deg[i]
            margin = EDGE * (high - low)
            outside = np.flatnonzero((degrees[:, i] < low - margin) | (degrees[:, i] > high + margin))
            if outside.size:
                k = int(outside[0])
                why = phrase(
                    "outside_learned_range",
                    joint=joint,
                    angle_deg=float(degrees[k, i]),
                    causes=effect.label,
                    low_deg=low,
                    high_deg=high,
                )
                raise targets.refusal(k, "x_mm, y_mm", why)


def range_said(model: LearnedModel) -> Phrase:
    """The range on which the model was learned."""
    (low1, high1), (low2, high2) = model.joint_range_deg
    learned = phrase(
        "learned_on",
        low1_deg=low1,
        high1_deg=high1,
        low2_deg=low2,
        high2_deg=high2,
        causes=" and ".join(effect.label for effect in model.acting) or "no effect",
    )
    if model.temperature_c is None:
        return learned
    at = phrase("learned_at_temperature", temperature_c=model.temperature_c)
    return phrase("sentences", first=learned, second=at)
