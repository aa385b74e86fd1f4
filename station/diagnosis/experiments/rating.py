"""All experiments that the station or a person can do, rated by the probability that they decide."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from station.diagnosis.experiments.by_hand import gauge, joint_reference, payload, second_mount
from station.diagnosis.experiments.further_motion import motion
from station.diagnosis.experiments.in_question import Hypothesis, hypotheses
from station.diagnosis.experiments.outcomes import Outcome, decides
from station.diagnosis.explanations import ExplanationSet

Kind = Literal["motion", "second_mount", "joint_reference", "payload", "gauge"]
STOPS = 40
COARSE = (9, 5)
Simulated = Callable[[ExplanationSet, Sequence[Hypothesis]], list[Outcome]]


@dataclass(frozen=True)
class Rated:
    """One experiment."""

    kind: Kind
    text: str
    decides: float


def rated(found: ExplanationSet) -> tuple[Rated, ...]:
    """Best first; empty if there is nothing to decide."""
    some = hypotheses(found)
    if len(some) < 2:
        return ()
    probability = [one.probability for one in some]
    out = [
        Rated("motion", TEXTS["motion"], decides(_motion(found, some), probability)),
        Rated("second_mount", TEXTS["second_mount"], decides(second_mount(found, some), probability)),
        _reference(found, some, probability),
        Rated("payload", TEXTS["payload"], decides(payload(found, some), probability)),
        Rated("gauge", TEXTS["gauge"], decides(gauge(found, some), probability)),
    ]
    return tuple(sorted(out, key=lambda one: -one.decides))


def _motion(found: ExplanationSet, some: Sequence[Hypothesis]) -> list[Outcome]:
    return list(motion(found, some, STOPS, COARSE).outcomes)


def _reference(found: ExplanationSet, some: Sequence[Hypothesis], probability: Sequence[float]) -> Rated:
    """The experiment at the joint that decides better."""
    values = [decides(joint_reference(found, some, joint), probability) for joint in (1, 2)]
    best = int(np.argmax(values))
    return Rated("joint_reference", TEXTS["joint_reference"].format(joint=best + 1), values[best])


TEXTS = {
    "motion": f"Read {STOPS} further positions where the explanations differ most.",
    "second_mount": "Mount the mechanism at a second point of the base and repeat the measurement sequence.",
    "joint_reference": "Measure the angle of proximal link {joint} with a level at five positions.",
    "payload": "Repeat the measurement sequence with a payload of 1 kg on the platform.",
    "gauge": "Compare the scale with a gauge or an interferometer at ten places of its travel.",
}
