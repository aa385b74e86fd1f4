"""A tracker beside the distance: it takes part in no fit and tells the true position error."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from station.diagnosis.report.report_page import page
from station.diagnosis.report.weighed_findings import WeighedFindings
from station.diagnosis.weighed_loop import weighed
from station.records import DataSource
from tests.station.simulated import ROBOT, Drawn

SOURCE = DataSource(file="walk.csv", readings=120, sha256="0" * 64)
BACKLASH = {"kind": "backlash", "joint": 1, "width_deg": 0.05}


@pytest.fixture(scope="module")
def tracked() -> WeighedFindings:
    machine = Drawn(BACKLASH, seed=2, tracked=True)
    return WeighedFindings(weighed(ROBOT, machine.sequence(), machine.fresh()))


def test_the_true_position_error_falls(tracked: WeighedFindings) -> None:
    errors = tracked.true_position_errors
    assert errors is not None
    before, after = errors
    assert after.rms < 0.5 * before.rms
    # half the play at joint 1 moves P by about a fifth of a millimetre
    predicted_before, predicted_after = tracked.position_errors
    assert before.rms == pytest.approx(predicted_before.rms, rel=0.5)
    assert after.rms < 3.0 * predicted_after.rms
    assert tracked.document(SOURCE).after.true_position_error_mm == after
    assert "True position error, against the tracker, mm" in page(tracked, "walk.csv").to_html()


def test_the_tracker_takes_part_in_no_fit(tracked: WeighedFindings) -> None:
    d = tracked.diagnosis
    assert d.measurements.tracker is not None and d.fresh is not None
    wrong = replace(d.measurements, tracker=d.measurements.tracker + 5.0)
    again = weighed(ROBOT, wrong, d.fresh)
    assert np.array_equal(again.found.mixture.mean, d.found.mixture.mean)


def test_without_a_tracker_nothing_is_said_of_it() -> None:
    machine = Drawn(BACKLASH, seed=2)
    findings = WeighedFindings(weighed(ROBOT, machine.sequence(), machine.fresh()))
    assert findings.true_position_errors is None
    assert findings.document(SOURCE).before.true_position_error_mm is None
