"""Plan `check` on machines that did not change, and on those whose zeros shifted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime

import numpy as np

from station.identification import identify
from station.records import CheckFound, Real
from station.run_kinds import check_run
from station.studies.drawn import Drawn, drawn, robot_of
from station.studies.plans.references import measured
from station.studies.walked import walk

SIZES = (0.25, 0.5, 0.75, 1.0)
"""Of the smallest shift that is stated."""
TOMORROW = datetime(2030, 1, 1, tzinfo=UTC)


@dataclass(frozen=True)
class Checked:
    """Checks of one machine."""

    smallest_deg: float
    false_alarm: bool
    still_p: float
    """p-value of the machine that did not change."""
    found: tuple[bool, ...]
    """Whether a shift of one zero was found, by size."""
    shifted_p: tuple[float, ...]


def checked(item: tuple[float, int]) -> Checked:
    """A full run, then plan `check` again and again: (tolerance, seed)."""
    machine, rng = drawn(robot_of(item[0]), item[1])
    fit = identify(machine.robot, measured(machine, "full", rng))

    def check(truth: Real, number: int) -> tuple[CheckFound, bool]:
        one = Drawn(machine.robot, truth, item[1]).machine(number)
        result = walk(check_run(fit, 0.0, TOMORROW), one).result
        assert result.check is not None
        return result.check, result.verdict == "fail"

    still, false_alarm = check(machine.truth, 1)
    joint = int(rng.integers(2))
    shift = np.radians(still.smallest_by_joint_deg[joint]) * rng.choice([-1.0, 1.0])
    found = [
        check(machine.truth + size * shift * (np.arange(len(machine.truth)) == joint), number)
        for number, size in enumerate(SIZES, start=2)
    ]
    return Checked(
        smallest_deg=still.smallest_shift_deg,
        false_alarm=false_alarm,
        still_p=still.p_value,
        found=tuple(failed for _, failed in found),
        shifted_p=tuple(one.p_value for one, _ in found),
    )


def operating_curve(found: Sequence[Checked], alarms: Sequence[float]) -> list[tuple[float, ...]]:
    """Share of shifts of each size found where so many machines that did not change are refused.

    :param alarms: shares of false alarms
    """
    still = [one.still_p for one in found]
    limits = [float(np.quantile(still, alarm)) for alarm in alarms]
    shifted = np.array([one.shifted_p for one in found])
    return [tuple(float(x) for x in (shifted < limit).mean(axis=0)) for limit in limits]
