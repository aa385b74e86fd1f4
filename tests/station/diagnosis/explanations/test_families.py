"""The families and the catalogue have a display name for everything that they report."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from station.diagnosis.explanations.catalogue import catalogue
from station.effects import arm_catalogue, five_bar_catalogue
from station.five_bar.mechanism import lengths
from station.messages import display_name, parameter_name
from tests.station.diagnosis.explanations.problems import ROBOT, linearised


def reported() -> Iterator[tuple[str, str]]:
    """Effect and parameter, of each family of a sequence and of each effect that the sequence can show."""
    at, _, reference = linearised()
    for family in catalogue(at.situation, lengths(ROBOT), thermometer=True):
        for part in family.parts if family.named else ():
            width = len(part.own)
            for quantity in part.quantities(family.hidden[0], np.ones(width), np.eye(width)):
                yield part.effect, quantity.name
    conditions = at.mechanism.conditions(at.p, reference, first=True)
    for effect in (*five_bar_catalogue(), *arm_catalogue(2, by_range=True)):
        if (shown := effect.variants(conditions)) is None:
            continue
        width = shown.basis.shape[2]
        for quantity in effect.quantities(shown.hidden[0], np.ones(width), np.eye(width)):
            yield effect.id, quantity.name


def test_every_parameter_of_an_effect_has_a_display_name() -> None:
    pairs = set(reported())
    assert len({effect for effect, _ in pairs}) > 12
    assert all(display_name("effects", effect) for effect, _ in pairs)
    # the identifier itself is what a parameter without an entry is called
    assert [pair for pair in sorted(pairs) if parameter_name(pair[1], "en") == pair[1]] == []
