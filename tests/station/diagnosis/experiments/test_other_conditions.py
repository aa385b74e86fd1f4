"""The same positions under other conditions tell explanations apart that no motion can."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from station.diagnosis.experiments import Hypothesis, hypotheses, rated
from station.diagnosis.experiments.asking import START_SD_MM, STOPS, asked, outcome, over_workspace
from station.diagnosis.experiments.other_conditions import LATER_S, SHIFT_MM, scale_start, warm_up
from station.diagnosis.explanations import ExplanationSet
from station.diagnosis.weighed_loop import weighed
from station.five_bar import Robot
from station.records import Real
from station.studies.confusion.machines import draw

ROBOT = Robot.default()


@cache
def found(kind: str, seed: int) -> ExplanationSet:
    drawn = draw(ROBOT, (kind,), seed)
    return weighed(ROBOT, drawn.sequence, drawn.fresh).found


def alone(kind: str, seed: int) -> tuple[ExplanationSet, Hypothesis]:
    (only,) = hypotheses(found(kind, seed))
    assert [part.effect for family in only.settled.families for part in family.parts] == [kind]
    return found(kind, seed), only


def plain(case: ExplanationSet, one: Hypothesis) -> Real:
    places, sides = over_workspace(case)
    return outcome(case, case.mechanism.of(asked(case, places, sides, STOPS)), one).mean


def test_a_drift_goes_on_for_the_hour_of_warming_up() -> None:
    case, one = alone("drift", 3)
    (warm,) = warm_up(case, [one])
    per_hour = float(one.settled.amplitudes[0][0])
    np.testing.assert_allclose(warm.mean - plain(case, one), per_hour * LATER_S / 3600.0, rtol=1e-9)
    assert abs(per_hour) > 1e-3


def test_a_ripple_of_the_scale_moves_with_the_scale_and_its_start_is_lost() -> None:
    case, one = alone("scale_cyclic", 4)
    (shifted,) = scale_start(case, [one])
    change = shifted.mean - plain(case, one)
    size = float(np.hypot(*one.settled.amplitudes[0]))
    (part,) = case.held(one.settled, 0)
    (period,) = (q.value for q in part.parameters if q.name == "period_mm")
    assert np.abs(change).max() == pytest.approx(2.0 * size * abs(np.sin(np.pi * SHIFT_MM / period)), rel=0.1)
    assert (np.diag(shifted.covariance) > START_SD_MM**2).all()


def test_a_joint_does_not_notice_where_the_scale_starts() -> None:
    case = found("encoder_eccentricity", 12)
    one = hypotheses(case)[0]
    (shifted,) = scale_start(case, [one])
    np.testing.assert_allclose(shifted.mean, plain(case, one), atol=1e-12)


def test_an_unnamed_error_by_time_may_be_anything_of_its_size_in_an_hour() -> None:
    case = found("mounting_creep", 2)
    some = hypotheses(case)
    later = next(k for k, one in enumerate(some) if one.settled.families[0].depends_on == "time")
    before, after = plain(case, some[later]), warm_up(case, some)[later]
    np.testing.assert_allclose(after.mean, before, atol=1e-12)
    places, sides = over_workspace(case)
    today = outcome(case, case.mechanism.of(asked(case, places, sides, STOPS)), some[later])
    more = np.diag(after.covariance) - np.diag(today.covariance)
    assert more.min() == pytest.approx(more.max()) and more.min() > 1e-8


def test_every_experiment_is_rated_best_first() -> None:
    some = rated(found("encoder_eccentricity", 12))
    assert {one.kind for one in some} == {
        "motion", "second_mount", "joint_reference", "payload", "warm_up", "scale_start", "gauge"
    }  # fmt: skip
    assert [one.decides for one in some] == sorted((one.decides for one in some), reverse=True)


def test_one_explanation_leaves_nothing_to_decide() -> None:
    case, _ = alone("drift", 3)
    assert rated(case) == ()
