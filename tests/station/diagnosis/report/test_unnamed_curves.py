"""The curve of a joint's error without a name, against the emulated machine's own error."""

from __future__ import annotations

import numpy as np

from station.diagnosis import WeighedFindings, weighed
from station.five_bar import Robot
from station.studies.confusion import draw
from station.studies.simulation import SimulatedMachine

ROBOT = Robot.default()


def test_the_band_holds_the_error_of_the_joint() -> None:
    worn = {"kind": "worn_sector", "joint": 2, "deg": 0.02, "at_deg": -15.0, "sector_deg": 40.0}
    truth = np.array([0.01, -0.02, *[0.0] * 8, 1.0, 0.5])
    sequence, fresh = SimulatedMachine(ROBOT, truth, "whole pulses", 5, [worn]).diagnostic_run(ROBOT, 5)
    (curve,) = WeighedFindings(weighed(ROBOT, sequence, fresh)).curves
    assert curve.joint == 2
    aside = (curve.angle_deg - ROBOT.zero_at_deg[1] + 15.0) / 40.0
    true_deg = np.where(np.abs(aside) < 0.5, -0.01 * (1.0 + np.cos(2.0 * np.pi * aside)), 0.0)
    # a constant is a zero offset, and no part of the curve
    off = curve.value_deg - true_deg
    off -= np.average(off, weights=curve.sd_deg**-2)
    assert np.mean(np.abs(off) < 2.0 * curve.sd_deg) > 0.9
    assert np.corrcoef(curve.value_deg, true_deg)[0, 1] > 0.9


def test_named_errors_have_no_curve() -> None:
    drawn = draw(ROBOT, ("backlash",), 3)
    assert WeighedFindings(weighed(ROBOT, drawn.sequence, drawn.fresh)).curves == ()
