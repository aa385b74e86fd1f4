"""The measurement model: truth found, uncertainty honest, nonsense refused."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from station.errors import InputRefused
from station.five_bar.kinematics import inverse
from station.five_bar.mechanism import FiveBar
from station.five_bar.robot_file import Robot
from station.identification import identification_document
from station.identification.estimate import identify
from station.plans import make_plan
from station.records import read_measurements
from tests.station.asking import start_procedure
from tests.station.simulated import DATA, calibrated, group, measure, needs_data, value_and_sd

ROBOT = Robot.default()
GRID = ROBOT.workspace_grid(7, 4)


@needs_data
@pytest.mark.parametrize("case", ["case01", "case02", "case03"])
def test_clean_files_give_the_truth_within_their_uncertainty(case: str) -> None:
    answers = json.loads((DATA / "undeclared/answers.json").read_text())[case]
    fit = identify(ROBOT, read_measurements(DATA / f"undeclared/{case}.csv"))
    assert fit.adequate
    assert fit.outliers == ()
    for q, truth in zip(fit.quantities()[:2], answers["zero_offsets_deg"], strict=True):
        assert abs(q.value - truth) < 3 * q.sd
        assert 0.01 < q.sd < 0.08
    assert fit.noise.source == "repeats"
    assert 0.0007 < fit.noise.sigma_mm < 0.0016


def test_an_outlying_reading_is_found_named_and_left_out() -> None:
    measurements = measure(ROBOT, group(1), GRID, 0, repeats=2)
    wrong = measurements.distance.copy()
    wrong[17] += 0.08
    fit = identify(ROBOT, replace(measurements, distance=wrong))
    assert [o.reading for o in fit.outliers] == [measurements.ids[17]]
    assert fit.outliers[0].residual_mm == pytest.approx(0.08, abs=0.02)
    assert "times the scatter" in fit.outliers[0].reason
    assert measurements.ids[17] not in fit.measurements.ids
    clean = identify(ROBOT, measurements)
    assert fit.dtheta == pytest.approx(clean.dtheta, abs=2e-4)


def test_a_disagreement_that_a_whole_place_shares_is_no_outlier() -> None:
    measurements = measure(ROBOT, group(1), GRID, 0, repeats=3)
    dented = measurements.distance + 0.05 * (measurements.position == 9)
    fit = identify(ROBOT, replace(measurements, distance=dented))
    assert fit.outliers == ()
    assert not fit.adequate
    assert fit.sd_factor > 3


def test_too_many_outliers_are_a_refusal() -> None:
    measurements = measure(ROBOT, group(1), GRID, 0)
    rng = np.random.default_rng(1)
    wrong = measurements.distance.copy()
    wrong[rng.choice(len(wrong), 6, replace=False)] += rng.choice([-0.3, 0.3], 6)
    with pytest.raises(InputRefused, match="disagree with the rest"):
        identify(ROBOT, replace(measurements, distance=wrong))


def test_a_link_three_millimetres_off_is_refused_by_name() -> None:
    truth = group(1)
    truth[6] = 3.0
    with pytest.raises(InputRefused, match="Impossible result: L1"):
        identify(ROBOT, measure(ROBOT, truth, GRID, 0))


def test_a_second_mount_has_its_own_offset_and_place() -> None:
    robot = replace(ROBOT, mounts={"B": (200.0, -79.0)})
    truth = group(1)
    first = measure(robot, truth, GRID, 0)
    aside = measure(replace(robot, c=(200.0, -79.0)), truth, GRID, 1)
    both = replace(
        first,
        ids=tuple(range(2 * len(first))),
        t_s=np.concatenate([first.t_s, aside.t_s + 1e3]),
        theta=np.concatenate([first.theta, aside.theta]),
        approach=np.concatenate([first.approach, aside.approach]),
        distance=np.concatenate([first.distance, aside.distance + 55.0]),
        position=np.concatenate([first.position, aside.position + len(first)]),
        mount=np.repeat([0, 1], len(first)),
        samples=np.concatenate([first.samples, aside.samples]),
        mounts=("A", "B"),
    )
    fit = identify(robot, both)
    alone = identify(robot, first)
    assert fit.quantities()[0].sd < 0.7 * alone.quantities()[0].sd
    names = [q.name for q in fit.quantities()]
    assert names[10:] == ["rMx", "rMy", "rMx@B", "rMy@B", "rho0", "rho0@B"]
    for value, true, sd in zip(
        np.degrees(fit.dtheta), np.degrees(truth[:2]), [q.sd for q in fit.quantities()[:2]], strict=True
    ):
        assert abs(value - true) < 3.5 * sd


def test_derivatives_with_two_mounts_agree_with_differences() -> None:
    robot = replace(ROBOT, mounts={"B": (150.0, -90.0)})
    measurements = replace(
        measure(robot, group(2), GRID, 0),
        mount=np.arange(len(GRID)) % 2,
        mounts=("A", "B"),
    )
    mechanism = FiveBar(robot, measurements)
    p = np.array([q.prior_mean for q in mechanism.parameters])
    at = mechanism.observe(p, mechanism.theta)
    for k in range(len(p)):
        step = np.zeros(len(p))
        step[k] = 1e-5 if k < 2 else 1e-3
        slope = (
            mechanism.observe(p + step, mechanism.theta).value
            - mechanism.observe(p - step, mechanism.theta).value
        ) / (2 * step[k])
        assert slope == pytest.approx(at.by_parameter[:, k], abs=1e-5 * (375 if k < 2 else 1))


def test_the_result_says_what_is_weak_and_blind() -> None:
    found = identify(ROBOT, measure(ROBOT, group(1), GRID, 0))
    content = identification_document(found).model_dump(by_alias=True)
    weak = content["weak_direction"]
    assert weak["text"] == "both arms together with a sideways error of the mechanism"
    assert len(weak["blind"]) == 3
    assert all(r["sd_deg"] < weak["sd_deg"] for r in weak["remedies"])
    common, differential = content["modes"]
    assert common["sd"] > 5 * differential["sd"]
    assert all(np.isfinite(q["sd"]) and q["sd"] > 0 for q in content["parameters"])
    field = content["position_error_map"]
    assert max(p["after_mm"] for p in field) == pytest.approx(
        content["after"]["predicted_position_error_mm"]["max"]
    )
    assert all(p["after_mm"] < p["before_mm"] for p in field)
    json.dumps(content, allow_nan=False)


@pytest.mark.parametrize("plan", ["rapid", "full"])
def test_measured_and_verified_calibration(plan: str) -> None:
    truth = group(1)
    result = calibrated(start_procedure(plan, ROBOT), ROBOT, truth, seed=4)
    value, sd = value_and_sd(result)
    assert result.verdict == "pass", result.reason
    assert (np.abs(np.array(value) - np.degrees(truth[:2])) < 3 * np.array(sd)).all()
    assert result.after is not None and (result.after.fresh_reading_rms_mm or 1.0) < 0.1


def test_an_effect_that_the_model_lacks_fails_the_calibration() -> None:
    """Backlash of 20 um would pass for geometry if nobody looked at the fit."""
    procedure = start_procedure("full", ROBOT)

    class Sloppy:
        def __next__(self) -> object:
            return next(procedure)

        def send(self, readings: list) -> object:  # type: ignore[type-arg]
            return procedure.send(
                [replace(r, scale_mm=r.scale_mm + 0.01 * (r.approach[0] or 1)) for r in readings]
            )

    result = calibrated(Sloppy(), ROBOT, group(1), seed=4)  # type: ignore[arg-type]
    assert result.verdict == "fail"
    assert result.reason.code == "lack_of_fit"


def test_full_plan_reads_every_place_from_both_sides_and_keeps_time_apart() -> None:
    plan = make_plan("full", ROBOT)
    assert len(plan.stops) == 120
    sides: dict[str, set[tuple[int, int]]] = {}
    for stop in plan.stops:
        sides.setdefault(stop.position, set()).add(stop.approach)
    assert len(sides) == 24
    assert all(len(s) == 2 for s in sides.values())
    place = np.array([complex(*s.target_mm) for s in plan.stops])
    time = np.arange(len(place))
    assert abs(np.corrcoef(time, place.real)[0, 1]) < 0.1
    assert abs(np.corrcoef(time, place.imag)[0, 1]) < 0.1
    assert np.degrees(inverse(ROBOT.geometry, place)) == pytest.approx(
        np.array([s.theta_deg for s in plan.stops])
    )


def test_plan_predicts_the_accuracy_in_words() -> None:
    assert "zero offsets to" in make_plan("rapid", ROBOT).summary()
