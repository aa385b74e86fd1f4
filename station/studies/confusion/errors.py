"""What an identified effect is worth: fresh readings and the true position, before and after."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from station.diagnosis import Around, WeighedFindings
from station.five_bar import Robot
from station.records import Real
from station.studies.confusion.machines import Drawn

GRID = (7, 5)
RUN_UP_DEG = 1.0


@dataclass(frozen=True)
class BeforeAndAfter:
    """RMS under the base model and under what was found."""

    reading_um: tuple[float, float]
    """Fresh readings less predicted."""
    position_um: tuple[float, float]
    """Where the end of the emulated machine truly stands, less where it was sent, over the workspace."""


def before_and_after(robot: Robot, drawn: Drawn, findings: WeighedFindings) -> BeforeAndAfter:
    """Of one machine, which goes on from where its fresh readings ended."""
    found = findings.found
    place = robot.workspace_grid(*GRID)
    approach = np.random.default_rng(0).choice([-1.0, 1.0], (len(place), 2))
    position = []
    for mixture in (found.mixture.only(found.base), found.mixture):
        # every place is come to from the side that was asked for
        theta = np.degrees(mixture.commands(place, Around(approach)))
        stops = np.stack([theta - RUN_UP_DEG * approach, theta], axis=1).reshape(-1, 2)
        position.append(_rms_um(np.abs(drawn.machine.stand(stops)[1::2] - place)))
    reading = [1e3 * (findings.stages[k].confirm_rms_mm or 0.0) for k in (1, -1)]
    return BeforeAndAfter((reading[0], reading[1]), (position[0], position[1]))


def _rms_um(error_mm: Real) -> float:
    return 1e3 * float(np.sqrt(np.mean(error_mm**2)))
