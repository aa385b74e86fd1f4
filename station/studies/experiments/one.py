"""One machine: diagnosed, and every experiment of an open question carried out on the emulated machine.

The emulated machine computes readings and angles from its own physics.  The explanations are then weighed
again by these, as the diagnosis predicted that it would do.
"""

from __future__ import annotations

import numpy as np

from station.diagnosis import Trial, trials, weighed
from station.errors import InputRefused
from station.five_bar import Robot
from station.studies.confusion import KINDS, draw
from station.studies.engine import Engine


def experiments(machines: int, seed: int, engine: Engine) -> list[tuple[Trial, ...]]:
    """One machine of each kind in turn, so many in all; empty where there was nothing to decide."""
    return engine.each(tried, [seed * 1_000_003 + k for k in range(machines)], "Machines")


def tried(seed: int) -> tuple[Trial, ...]:
    """All experiments on the machine of this seed."""
    robot = Robot.default()
    drawn = draw(robot, KINDS[seed % len(KINDS)], seed)
    try:
        found = weighed(robot, drawn.sequence, drawn.fresh).found
    except InputRefused:
        return ()
    return trials(found, drawn.machine, np.random.default_rng(seed))
