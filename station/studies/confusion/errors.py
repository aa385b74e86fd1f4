"""What an explanation is worth: fresh readings and the true position, before and after."""

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
    """RMS under the base model and under the set of explanations."""

    reading_um: tuple[float, float]
    """Fresh readings less predicted."""
    position_um: tuple[float, float]
    """Where the end of the emulated machine truly stands, less where it was sent, over the workspace."""
    largest_um: float
    """Of the position afterwards."""
    bound_um: float
    """95 % bound that was stated for it."""

    @property
    def worse(self) -> bool:
        """Noticeably worse than before, and more than was said."""
        return self.position_um[1] > 1.2 * self.position_um[0] and self.largest_um > self.bound_um


def before_and_after(robot: Robot, drawn: Drawn, findings: WeighedFindings) -> BeforeAndAfter:
    """Of one machine, which goes on from where its fresh readings ended."""
    found = findings.found
    place = robot.workspace_grid(*GRID)
    approach = np.random.default_rng(0).choice([-1.0, 1.0], (len(place), 2))
    off = []
    for mixture in (found.mixture.only(found.base), found.mixture):
        # every place is come to from the side that was asked for
        theta = np.degrees(mixture.commands(place, Around(approach)))
        stops = np.stack([theta - RUN_UP_DEG * approach, theta], axis=1).reshape(-1, 2)
        off.append(np.abs(drawn.machine.stand(stops)[1::2] - place))
    reading = [1e3 * (findings.stages[k].confirm_rms_mm or 0.0) for k in (1, -1)]
    bound_um = 1e3 * found.position_error[1].bound_95
    return BeforeAndAfter(
        (reading[0], reading[1]), (_rms_um(off[0]), _rms_um(off[1])), 1e3 * float(off[1].max()), bound_um
    )


def _rms_um(error_mm: Real) -> float:
    return 1e3 * float(np.sqrt(np.mean(error_mm**2)))
