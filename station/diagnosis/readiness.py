"""Whether readings are sufficient to be judged, before any search."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from station.diagnosis.tests_of_fit import FEWEST
from station.errors import InputRefused
from station.fitting import FEWEST_REPEATS
from station.mechanism import Mechanism
from station.records import Index, Measurements

FEWEST_READINGS = 30
"""With fewer readings, thirteen unknowns and an effect leave too little to judge a residual."""
FEWEST_OF_ARM = 24
"""Minimum number of readings of an arm: three quarters of 32."""


def check_enough(mechanism: Mechanism, *, labelled: bool = True) -> None:
    """:raises InputRefused: "not enough data to judge"; the error states what is missing.

    :param labelled: whether the labels of positions can be trusted; otherwise there are no repeats
    """
    measurements, unknowns = mechanism.measurements, len(mechanism.parameters)
    groups = measurements.repeat_group
    repeats = len(groups) - len(np.unique(groups))
    # an arm has a tolerance for each unknown of its links, so fewer readings than unknowns are acceptable
    fewest = max(FEWEST_READINGS, 2 * unknowns) if mechanism.needs_repeats else FEWEST_OF_ARM
    missing = []
    if len(measurements) < fewest:
        missing.append(f"{fewest - len(measurements)} more readings")
    if mechanism.needs_repeats and labelled and repeats < FEWEST_REPEATS:
        missing.append(
            f"{FEWEST_REPEATS - repeats} more repeats (readings that share `position` and approach)"
        )
    if missing:
        raise InputRefused(f"Not enough data to judge: {' and '.join(missing)} are needed.")


def checked_fresh(mechanism: Mechanism, fresh: Measurements) -> Measurements:
    """Fresh readings to compare with those of `mechanism`, with the same numbers for mounts and set-ups.

    :raises InputRefused: impossible poses, too few readings, or a mount or set-up that was not learned.
    """
    learned = mechanism.measurements
    fresh = replace(
        fresh,
        mount=_renumbered(fresh.mount, fresh.mounts, learned.mounts, "mount"),
        mounts=learned.mounts,
        setup=_renumbered(fresh.setup_index, fresh.setups, learned.setups, "set-up"),
        setups=learned.setups,
    )
    mechanism.of(fresh).check()
    if len(fresh) < FEWEST:
        raise InputRefused(f"Only {len(fresh)} fresh readings; at least {FEWEST} are needed to confirm.")
    return fresh


def _renumbered(own: Index, labels: tuple[str, ...], learned: tuple[str, ...], what: str) -> Index:
    unknown = [labels[k] for k in np.unique(own) if labels[k] not in learned]
    if unknown:
        raise InputRefused(
            f"The fresh readings are of {what} {unknown[0]!r}, which the measurement sequence never used."
        )
    return np.array([learned.index(name) if name in learned else 0 for name in labels])[own]
