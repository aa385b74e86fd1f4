"""References: each a measurement with its own uncertainty in the fit, counted once, doubted where needed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from station.errors import InputRefused
from station.five_bar import FiveBar, Robot, measured_value
from station.identification import Identification, identify
from station.identification.references import contradicted
from station.plans import make_plan
from station.records import AnyReference, JointAngle, Measurements, MountingError, Real
from station.studies.drawn import errors_of
from station.studies.simulation import SimulatedMachine

ROBOT = Robot.default()
TRUTH = errors_of(ROBOT, np.random.default_rng(5))


@pytest.fixture(scope="module")
def readings() -> Measurements:
    return SimulatedMachine(ROBOT, TRUTH, "whole pulses", 5).measure(make_plan("rapid", ROBOT).stops)


def seen(truth: Real, off_deg: float = 0.0) -> JointAngle:
    """Joint 1 at -3 degrees, as a level sees it."""
    reads = -3.0 + float(np.degrees(truth[0])) + off_deg
    return JointAngle(joint=1, at_deg=-3.0, reads_deg=reads, sd_deg=0.005)


def fit(readings: Measurements, *references: AnyReference) -> Identification[FiveBar]:
    return identify(ROBOT.informed(references), readings)


def sd_deg(found: Identification[FiveBar]) -> Real:
    return np.degrees(np.sqrt(np.diag(found.covariance)[:2]))


def test_a_reference_is_one_more_row_of_the_fit(readings: Measurements) -> None:
    """Against the normal equations with the row written out."""
    plain, reference = fit(readings), seen(TRUTH, 0.003)
    with_it = fit(readings, reference)
    value, sd = measured_value(reference, ROBOT)
    row = np.zeros(len(plain.p))
    row[0] = 1.0 / sd
    covariance = np.linalg.inv(np.linalg.inv(plain.solution.covariance) + np.outer(row, row))
    expected = plain.p + covariance @ row * (value - plain.p[0]) / sd
    np.testing.assert_allclose(with_it.solution.covariance[:2, :2], covariance[:2, :2], rtol=2e-2)
    np.testing.assert_allclose(with_it.dtheta, expected[:2], atol=2e-2 * sd)


@pytest.mark.parametrize(
    ("reference", "words"),
    [
        (
            JointAngle(joint=1, at_deg=0.0, reads_deg=0.0, sd_deg=1e300),
            "uncertainty of 1e\\+300 deg; 1e-05 to 12",
        ),
        (JointAngle(joint=2, at_deg=180.0, reads_deg=180.0, sd_deg=1e-12), "uncertainty of 1e-12 deg"),
        (MountingError(kind="drm_x", value_mm=1.0, sd_mm=1e-300), "uncertainty of 1e-300 mm"),
        (MountingError(kind="drm_y", value_mm=1.0, sd_mm=5.0), "uncertainty of 5 mm"),
    ],
)
def test_an_uncertainty_that_no_instrument_has_is_refused(reference: AnyReference, words: str) -> None:
    with pytest.raises(InputRefused, match=words):
        ROBOT.informed([reference])


def test_it_ties_down_what_readings_cannot(readings: Measurements) -> None:
    plain, with_it = sd_deg(fit(readings)), sd_deg(fit(readings, seen(TRUTH)))
    assert (plain > 0.03).all()
    assert (with_it < 0.015).all()
    found = fit(readings, seen(TRUTH))
    assert (np.abs(np.degrees(found.dtheta - TRUTH[:2])) < 4.0 * with_it).all()


def test_it_agrees_or_is_doubted(readings: Measurements) -> None:
    good = fit(readings, seen(TRUTH)).references[0]
    assert good.p_value is not None
    assert good.p_value > 1e-3
    assert contradicted((good,)) is None
    wrong = fit(readings, seen(TRUTH, 1.0)).references[0]
    assert contradicted((good, wrong)) == wrong
    assert wrong.residual is not None
    assert wrong.residual == pytest.approx(1.0, abs=0.5)


def test_a_mounting_error_measured_helps_sideways_only(readings: Measurements) -> None:
    sideways = MountingError(kind="drm_x", value_mm=float(TRUTH[10]), sd_mm=0.02)
    height = MountingError(kind="drm_y", value_mm=float(TRUTH[11]), sd_mm=0.02)
    plain = sd_deg(fit(readings))
    assert (sd_deg(fit(readings, sideways)) < 0.5 * plain).all()
    assert (sd_deg(fit(readings, height)) > 0.9 * plain).all()


def test_the_memory_counts_a_measured_mounting_once(readings: Measurements) -> None:
    sideways = MountingError(kind="drm_x", value_mm=float(TRUTH[10]), sd_mm=0.02)
    robot = ROBOT.informed([sideways])
    memory = identify(robot, readings).lasting
    assert memory.references == (sideways,)
    assert memory.informed(robot)[0] is memory
    again = identify(robot, readings, memory)
    assert again.references == ()
    assert again.lasting.references == (sideways,)


def test_a_new_measurement_of_the_mounting_narrows_the_memory_or_refutes_it(readings: Measurements) -> None:
    memory = identify(ROBOT, readings).lasting
    i = memory.names.index("rMx")
    true = MountingError(kind="drm_x", value_mm=float(TRUTH[10]), sd_mm=0.02)
    narrower, p_value = memory.informed(ROBOT.informed([true]))
    assert np.sqrt(narrower.covariance[i, i]) < 0.021
    assert p_value > 1e-3
    remounted = true.model_copy(update={"value_mm": true.value_mm + 2.0})
    gate = identify(ROBOT.informed([remounted]), readings, memory).gate
    assert gate is not None
    assert not gate.used


def test_an_angle_is_counted_within_half_a_turn() -> None:
    assert JointAngle(joint=2, at_deg=180.0, reads_deg=-179.9, sd_deg=0.01).offset_deg == pytest.approx(0.1)


@pytest.mark.parametrize(
    "reference",
    [
        JointAngle(joint=1, at_deg=0.0, reads_deg=20.0, sd_deg=0.01),
        MountingError(kind="drm_x", value_mm=100.0, sd_mm=0.02),
    ],
)
def test_what_cannot_be_is_refused(reference: AnyReference) -> None:
    with pytest.raises(InputRefused, match="Check the value, its sign"):
        ROBOT.informed([reference])


def test_the_robot_file_keeps_measurements_of_the_mechanism_alone(tmp_path: Path) -> None:
    file = tmp_path / "robot.toml"
    file.write_text(
        '[robot]\nserial = "R7"\naccuracy_mm = 0.2\n'
        '[[mechanism.reference]]\nkind = "drm_x"\nvalue_mm = 1.02\nsd_mm = 0.02\n'
    )
    robot = Robot.from_toml(file)
    assert robot.references == (MountingError(kind="drm_x", value_mm=1.02, sd_mm=0.02),)
    joint = JointAngle(joint=1, at_deg=0.0, reads_deg=0.01, sd_deg=0.005)
    kept = Robot.from_dict(robot.informed([joint]).to_json())
    assert (kept.references, kept.accuracy_mm) == (robot.references, 0.2)
    assert "reference" not in ROBOT.to_json()["mechanism"]
    file.write_text('[[mechanism.reference]]\nkind = "joint_angle"\nvalue_mm = 1\nsd_mm = 0.02\n')
    with pytest.raises(InputRefused, match="drm_x"):
        Robot.from_toml(file)
