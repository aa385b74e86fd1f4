"""Plain pipelines learn from what the loop learned from, and are judged by what judged the loop."""

from __future__ import annotations

import numpy as np
import pytest

from station.diagnosis.report.stages import kept_fresh
from station.diagnosis.tests_of_fit.cross_validation import without_a_quarter
from station.diagnosis.traced_loop import traced
from station.studies.arms.physics import UR_LIKE, random_arm, random_poses
from station.studies.plain_pipelines import pipelines


def test_every_pipeline_is_judged_by_the_readings_that_judged_the_loop() -> None:
    pytest.importorskip("sklearn")
    # a slow error of joint 2 that any of them can learn a part of, and nothing for the loop to choose from
    arm = random_arm(UR_LIKE, 41, j2=lambda theta: np.radians(0.2) * np.sin(3.0 * theta))
    d = traced(arm.robot, *without_a_quarter(arm.log(random_poses(6, 80, 41), 41)), effects=())
    found = pipelines(d, kept_fresh(d))
    assert found["DH fit"] == pytest.approx(d.confirmations[0].rms_mm)
    assert set(found) == {
        "DH fit",
        "+ Gaussian process",
        "+ boosted trees",
        "+ joint curves",
        "+ curves and process",
    }
    assert found["+ joint curves"] < 0.8 * found["DH fit"]
