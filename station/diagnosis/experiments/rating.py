"""All experiments that the station or a person can do, rated by the probability that they decide."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from station.diagnosis.experiments.asking import STOPS
from station.diagnosis.experiments.by_hand import gauge, joint_reference, second_mount
from station.diagnosis.experiments.further_motion import motion
from station.diagnosis.experiments.in_question import Hypothesis, hypotheses
from station.diagnosis.experiments.other_conditions import (
    SHIFT_MM,
    WARMER_K,
    payload,
    scale_start,
    warm_up,
)
from station.diagnosis.experiments.outcomes import Outcome, decides
from station.diagnosis.explanations import ExplanationSet
from station.records import Phrase, phrase

Kind = Literal["motion", "second_mount", "joint_reference", "payload", "warm_up", "scale_start", "gauge"]
PAYLOAD_KG = 1.0
"""A payload that about doubles the sag; its prediction needs no mass."""
COARSE = (9, 5)
Simulated = Callable[[ExplanationSet, Sequence[Hypothesis]], list[Outcome]]


@dataclass(frozen=True)
class Rated:
    """One experiment."""

    kind: Kind
    said: Phrase
    decides: float


def rated(found: ExplanationSet) -> tuple[Rated, ...]:
    """Best first; empty if there is nothing to decide."""
    some = hypotheses(found)
    if len(some) < 2:
        return ()
    probability = [one.probability for one in some]
    simulated: list[tuple[Kind, Phrase, Simulated]] = [
        ("motion", phrase("experiment_motion", stops=STOPS), _motion),
        ("second_mount", phrase("experiment_second_mount"), second_mount),
        ("payload", phrase("experiment_payload", payload_kg=PAYLOAD_KG), payload),
        ("warm_up", phrase("experiment_warm_up", kelvin=WARMER_K), warm_up),
        ("scale_start", phrase("experiment_scale_start", shift_mm=SHIFT_MM), scale_start),
        ("gauge", phrase("experiment_gauge"), gauge),
    ]
    out = [Rated(kind, said, decides(run(found, some), probability)) for kind, said, run in simulated]
    out.append(_reference(found, some, probability))
    return tuple(sorted(out, key=lambda one: -one.decides))


def _motion(found: ExplanationSet, some: Sequence[Hypothesis]) -> list[Outcome]:
    return list(motion(found, some, STOPS, COARSE).outcomes)


def _reference(found: ExplanationSet, some: Sequence[Hypothesis], probability: Sequence[float]) -> Rated:
    """The experiment at the joint that decides better."""
    values = [decides(joint_reference(found, some, joint), probability) for joint in (1, 2)]
    best = int(np.argmax(values))
    return Rated("joint_reference", phrase("experiment_joint_reference", joint=best + 1), values[best])
