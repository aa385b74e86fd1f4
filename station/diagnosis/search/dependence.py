"""Dependences of an unexplained residual, found without the catalogue.

Each test's null hypothesis is that the residual does not depend on the named quantity; Holm's procedure keeps
the probability of any false hint at `LEVEL`. Smooth dependences are those of `departures`; along each angle
and the travel a periodogram searches for shorter ones (Lomb, Astrophysics and Space Science 39, 1976), with
the false-alarm probability of the whole search.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.special import fdtrc

from station.diagnosis.search.scan import explained
from station.diagnosis.tests_of_fit import (
    Departure,
    WhitenedResidual,
    added,
    by_approach_and_place,
    departures,
    half_waves,
    in_doubt,
    perpendicular,
    senses,
)
from station.effects import OVERSAMPLING, waves
from station.records import Phrase, Real, phrase

LEVEL = 0.01
LOCAL_SHARE = 0.15
"""Share of the effect of the sense of approach above which its variation over positions is relevant."""
NEAR_MM = 40.0
MOST_PER_TURN = 80.0
SHORTEST_MM = 0.4
SHARPER = 0.05
"""Share of the residual's sum of squares by which a period must exceed a smooth course to be reported."""


@dataclass(frozen=True)
class Hint:
    """One quantity that the residual depends on."""

    depends_on: str
    strength: float
    """Share of the residual's sum of squares that it accounts for, 0 to 1."""
    p_value: float
    said: Phrase


def hints(residual: WhitenedResidual) -> tuple[Hint, ...]:
    """Significant dependences of a model's residual, strongest first."""
    found = sorted(_tests(residual), key=lambda h: h.p_value)
    kept = []
    for k, hint in enumerate(found):
        if hint.p_value * (len(found) - k) > LEVEL:
            break
        kept.append(hint)
    return tuple(sorted(kept, key=lambda h: -h.strength))


def _tests(residual: WhitenedResidual) -> Iterator[Hint]:
    theta, travel = residual.of("theta"), residual.of("travel")
    for found in departures(residual):
        match found.on:
            case "time":
                yield _hint(found, phrase("residual_time"))
            case "approach x place":
                yield _by_approach(residual, found)
            case "place":
                yield _hint(found, _at(_worst_place(residual)))
            case "travel":
                period, wave = _periodic(residual, travel, 1.0 / SHORTEST_MM)
                waves = phrase("residual_travel_period", period_mm=period)
                yield _either(found, phrase("residual_travel"), wave, waves)
            case joint:
                number = int(joint.removeprefix("theta"))
                period, wave = _periodic(residual, theta[:, number - 1], MOST_PER_TURN / (2.0 * np.pi))
                waves = phrase("residual_joint_period", joint=number, per_turn=2.0 * np.pi / period)
                yield _either(found, phrase("residual_joint", joint=number), wave, waves)
    if residual.recorded("temperature_rise"):
        course = added(residual, "temperature", half_waves(residual.of("temperature_rise"), 2))
        yield _hint(course, phrase("residual_temperature"))


def _hint(found: Departure, said: Phrase) -> Hint:
    return Hint(found.on, found.share, found.p_value, said)


def _either(smooth: Departure, course: Phrase, wave: Departure, waves: Phrase) -> Hint:
    """A smooth course, or the waves where they account for more."""
    if wave.p_value < LEVEL and wave.share > smooth.share + SHARPER:
        return Hint(smooth.on, wave.share, wave.p_value, waves)
    return _hint(smooth, course)


def _by_approach(residual: WhitenedResidual, found: Departure) -> Hint:
    """Whether the sense of approach has the same effect everywhere, or one that varies with position."""
    alike = senses(residual)
    local = added(
        residual, found.on, by_approach_and_place(residual), np.column_stack([alike, in_doubt(residual)])
    )
    if local.p_value < LEVEL and local.share > LOCAL_SHARE * found.share:
        return _hint(found, phrase("residual_approach_by_place"))
    common = added(residual, "approach", alike, in_doubt(residual))
    return _hint(common, phrase("residual_approach"))


def _at(where: Real) -> Phrase:
    """The residual belongs to this position, (2,) or (3,) mm."""
    x, y, *z = map(float, where)
    if z:
        return phrase("residual_place_in_space", x_mm=x, y_mm=y, z_mm=z[0])
    return phrase("residual_place", x_mm=x, y_mm=y)


def _worst_place(residual: WhitenedResidual) -> Real:
    """(d,) mm, the position where the mean of the neighbourhood exceeds the noise most."""
    apart = np.linalg.norm(residual.at[:, None] - residual.at[None, :], axis=2)
    near = np.exp(-0.5 * (apart / NEAR_MM) ** 2)
    left = np.zeros((len(residual.at), int(residual.axis.max()) + 1))
    left[residual.reading, residual.axis] = residual.left[: len(residual.reading)]
    mean = np.linalg.norm(near @ left, axis=1) / np.linalg.norm(near, axis=1)
    return np.asarray(residual.at[int(np.argmax(mean))])


def _periodic(residual: WhitenedResidual, along: Real, highest: float) -> tuple[float, Departure]:
    """The period along a quantity that takes most, up to `highest` periods per unit, and its share."""
    span = float(np.ptp(along))
    lowest, step = 2.0 / (span or 1.0), 1.0 / (span or 1.0) / OVERSAMPLING
    count = int((highest - lowest) / step)
    if count < 1:
        return np.inf, Departure("period", 0.0, 1.0)
    turns = waves(along, 2.0 * np.pi * lowest, 2.0 * np.pi * step, count)
    flat = perpendicular(residual.spread(turns.transpose(1, 0, 2).reshape(len(along), -1)), residual.taken)
    # coordinate by coordinate: each has separate amplitudes
    won = np.zeros(count)
    for own in np.split(flat, flat.shape[1] // (2 * count), axis=1):
        pairs = own.reshape(len(own), count, 2).transpose(1, 0, 2)
        won += explained(pairs.transpose(0, 2, 1) @ pairs, (residual.left @ own).reshape(count, 2))[0]
    best, size = int(np.argmax(won)), flat.shape[1] // count
    dof = residual.dof - size
    noise = max(residual.square - float(won[best]), 1e-12) / dof
    trials = 2.0 * highest * span
    p_value = min(1.0, trials * float(fdtrc(size, dof, won[best] / size / noise)))
    share = max(float(won[best]) - size * noise, 0.0) / residual.square
    return 1.0 / (lowest + best * step), Departure("period", share, p_value)
