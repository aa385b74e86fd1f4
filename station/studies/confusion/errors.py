"""What an identified effect is worth: fresh readings and the true position, before and after."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from station.diagnosis import Diagnosis, kept_fresh
from station.five_bar import Robot
from station.mechanism import temperature_rise
from station.model import Situation, identified
from station.records import Real
from station.studies.confusion.machines import Drawn

GRID = (7, 5)
RUN_UP_DEG = 1.0


@dataclass(frozen=True)
class BeforeAndAfter:
    """RMS under the base model and under the one that the diagnosis trusts."""

    reading_um: tuple[float, float]
    """Fresh readings less predicted."""
    position_um: tuple[float, float]
    """Where the end of the emulated machine truly stands, less where it was sent, over the workspace."""


def before_and_after(robot: Robot, drawn: Drawn, found: Diagnosis) -> BeforeAndAfter:
    """Of one machine, which goes on from where its fresh readings ended."""
    trusted = found.decision.trusted
    models = found.base, found.trace.stages[trusted].fit
    kept = kept_fresh(found)
    checks = found.confirmations[0], found.confirmations[trusted]
    place = robot.workspace_grid(*GRID)
    approach = np.random.default_rng(0).choice([-1.0, 1.0], (len(place), 2))
    rise = temperature_rise(drawn.fresh, found.base.model.reference)
    warm = np.full(len(place), 0.0 if rise is None else rise[-1])
    position = []
    for model in models:
        machine = identified(model)
        assert machine is not None, "five-bars alone are drawn here"
        commands = machine.commands(place, Situation(approach, warm, np.zeros(len(place))))
        # every place is come to from the side that was asked for
        theta = np.degrees(commands)
        stops = np.stack([theta - RUN_UP_DEG * approach, theta], axis=1).reshape(-1, 2)
        position.append(_rms_um(np.abs(drawn.machine.stand(stops)[1::2] - place)))
    reading = [_rms_um(check.error_mm[kept]) for check in checks]
    return BeforeAndAfter((reading[0], reading[1]), (position[0], position[1]))


def _rms_um(error_mm: Real) -> float:
    return 1e3 * float(np.sqrt(np.mean(error_mm**2)))
