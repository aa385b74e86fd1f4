"""A set of explanations restored from a file, for commands.

The shapes of the errors depend on the readings that they were found with, so the file contains those too.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from station.diagnosis.explanations.catalogue import catalogue
from station.diagnosis.explanations.evidence import Choice
from station.diagnosis.explanations.family import Family
from station.diagnosis.explanations.mixture import Mixture
from station.diagnosis.explanations.settle import Settled
from station.diagnosis.explanations.situation import at_readings
from station.diagnosis.explanations.smooth_processes import wanderings
from station.five_bar import FiveBar, lengths
from station.mechanism import Reference
from station.records import Real


@dataclass(frozen=True)
class KeptError:
    """One error with all its parameters fixed."""

    family: int
    kind: str
    hidden: Mapping[str, float]
    amplitudes: Real


@dataclass(frozen=True)
class KeptExplanation:
    """One explanation."""

    probability: float
    values: Real
    """(P,) base parameters."""
    errors: tuple[KeptError, ...]


class NotInCatalogue(LookupError):
    """The file contains an error that this version of the station does not have."""


def restored(
    mechanism: FiveBar, start: Real, reference: Reference, kept: Sequence[KeptExplanation]
) -> Mixture:
    """:raises NotInCatalogue: the set contains an error of another version of the catalogue.

    :param mechanism: with the readings that the set was weighed on
    :param start: (P,) base parameters at which its catalogue was made
    """
    situation = at_readings(mechanism, start, reference)
    recorded = mechanism.measurements.temperature_c is not None
    families = (
        *catalogue(situation, lengths(mechanism.robot), thermometer=recorded),
        *wanderings(situation),
    )
    weight = np.array([one.probability for one in kept])
    settled = tuple(_settled(one, families, mechanism) for one in kept)
    return Mixture(mechanism, situation, settled, weight / weight.sum())


def _settled(one: KeptExplanation, families: Sequence[Family], mechanism: FiveBar) -> Settled:
    x = np.concatenate([one.values, *(error.amplitudes for error in one.errors)])
    return Settled(
        choices=tuple(Choice(error.family, 0, 0) for error in one.errors),
        families=tuple(_family(error, families) for error in one.errors),
        x=x,
        covariance=np.zeros((len(x), len(x))),
        log_evidence=0.0,
        cost=0.0,
        level=1.0,
        bend=0.0,
        row_sd=mechanism.row_sd,
    )


def _family(error: KeptError, families: Sequence[Family]) -> Family:
    if not 0 <= error.family < len(families) or families[error.family].kind != error.kind:
        raise NotInCatalogue(f"{error.kind!r} (number {error.family})")
    return replace(families[error.family], hidden=(error.hidden,), width=len(error.amplitudes))
