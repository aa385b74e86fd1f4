"""The error map of a stored run: equal to what an emulated machine truly does, and to the run's promise."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from station.errors import NotApplicable, NotFound
from station.fitting import ErrorFields
from station.five_bar import Robot, inverse
from station.identification import bounds_mm, error_fields, identify
from station.plans import make_plan
from station.records import Complex, ErrorMap, JointAngle, Real, State
from station.run_kinds import RUN_KINDS, Start, error_map
from station.settings import JointSettings, Settings
from station.store import Store
from station.studies.drawn import drawn, robot_of
from station.studies.simulation import SimulatedMachine, true_positions
from tests.station.asking import asked
from tests.station.run_kinds.test_diagnose import BACKLASH, machine, run
from tests.station.simulated import carried_out, group

ROBOT = replace(Robot.default("R1"), accuracy_mm=1.5)
TRUTH = group(1)
JOINTS = Settings().joints
PLANS = {"full": 1, "rapid": 2, "paper": 3, "adaptive": 4}


@pytest.fixture(scope="module")
def store(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Store]:
    """Runs 1 to 4 by plan, of one simulated machine; run 5 diagnosed a machine with play."""
    with closing(Store(tmp_path_factory.mktemp("maps") / "station.db")) as store:
        for seed, plan in enumerate(PLANS):
            request = asked("R1", plan)
            procedure = RUN_KINDS[request.kind].procedure
            assert procedure is not None
            # alone in a store of its own: nothing is remembered from one plan to the next
            with closing(Store(tmp_path_factory.mktemp(plan) / "station.db")) as alone:
                simulated = SimulatedMachine(ROBOT, TRUTH, "exact", seed)
                readings, result = carried_out(simulated, procedure(Start(alone, request, ROBOT)), samples=5)
            store.add_run(request, ROBOT, readings, result)
        readings, result = run(machine(BACKLASH))
        store.add_run(asked("R1", "diagnostic"), ROBOT, readings, result)
        yield store


def values(grid: tuple[tuple[float | None, ...], ...]) -> Real:
    return np.array(grid, dtype=float)


def places_of(found: ErrorMap) -> Complex:
    return np.asarray(np.array(found.x_mm)[None] + 1j * np.array(found.y_mm)[:, None])


@pytest.mark.parametrize("plan", PLANS)
def test_before_and_after_are_what_the_machine_does(store: Store, plan: str) -> None:
    """Against the emulated machine's own geometry, at drive angles with and without the zero offsets."""
    found = error_map(store, PLANS[plan], JOINTS)
    places = places_of(found)
    commanded = inverse(ROBOT.geometry, places.ravel())
    zeros = np.radians([zero.value_deg or 0.0 for zero in store.calibration(PLANS[plan]).zero_offsets])
    true = [
        np.abs(true_positions(ROBOT, TRUTH, theta) - places.ravel()).reshape(places.shape)
        for theta in (commanded, commanded - zeros)
    ]
    bound = values(found.after_95_mm)
    assert np.median(true[0]) > 10.0  # the zeros are degrees off
    assert (np.abs(values(found.before_mm) - true[0]) < bound).all()
    assert (true[1] < bound).all() and (values(found.after_mm) < bound).all()


@pytest.mark.parametrize("run", [*PLANS.values(), 5])
def test_the_largest_bound_is_the_promise_of_the_run(store: Store, run: int) -> None:
    found, accuracy = error_map(store, run, JOINTS), store.calibration(run).accuracy
    assert accuracy is not None
    assert found.bound_95_mm == accuracy.bound_95_mm
    assert values(found.after_95_mm).max() == pytest.approx(found.bound_95_mm, abs=1e-6)


def test_the_expected_error_is_that_of_the_record(store: Store) -> None:
    found, after = error_map(store, 1, JOINTS), store.calibration(1).after
    assert after is not None and after.predicted_position_error_mm is not None
    assert values(found.after_mm).max() == pytest.approx(after.predicted_position_error_mm.max, rel=1e-3)


def test_the_grid_is_the_workspace(store: Store) -> None:
    found = error_map(store, 1, JOINTS)
    assert (found.x_mm[0], found.x_mm[-1]) == ROBOT.workspace_x
    assert (found.y_mm[0], found.y_mm[-1]) == ROBOT.workspace_y
    assert (len(found.x_mm), len(found.y_mm)) == (37, 12)
    assert values(found.before_mm).shape == (12, 37)


@pytest.mark.parametrize("run", [1, 2, 3, 5])
def test_fresh_readings_stand_where_they_were_taken(store: Store, run: int) -> None:
    """Their residuals are those that the record sums up."""
    found, after = error_map(store, run, JOINTS).fresh, store.calibration(run).after
    assert after is not None and len(found) == (40 if run == 5 else 8)
    residual = np.array([one.residual_mm for one in found])
    assert np.sqrt(np.mean(residual**2)) == pytest.approx(after.fresh_reading_rms_mm, rel=1e-4)
    (left, right), (low, high) = ROBOT.workspace_x, ROBOT.workspace_y
    assert all(left < one.x_mm < right and low < one.y_mm < high for one in found)


def test_without_fresh_readings_there_are_none(store: Store) -> None:
    assert error_map(store, PLANS["adaptive"], JOINTS).fresh == ()


def test_the_limit_is_what_was_wanted(store: Store) -> None:
    assert error_map(store, 1, JOINTS).limit_mm == ROBOT.accuracy_mm
    assert error_map(store, 5, JOINTS).limit_mm is None


def test_where_a_joint_may_not_be_sent_there_is_no_value(store: Store) -> None:
    narrow = JointSettings(unit=1, zero_at_deg=0.0, reach_deg=12.0)
    found = error_map(store, 1, (narrow, JOINTS[1]))
    theta = inverse(ROBOT.geometry, places_of(found).ravel())[:, 0].reshape(12, 37)
    for grid in (found.before_mm, found.after_mm, found.after_95_mm):
        assert (np.isnan(values(grid)) == (np.abs(np.degrees(theta)) > 12.0)).all()
    assert 0 < np.isnan(values(found.after_mm)).sum() < 444
    assert np.nanmax(values(found.after_95_mm)) == pytest.approx(found.bound_95_mm, abs=1e-6)


def applied(store: Store, run: int, share: float, verdict: str) -> int:
    """An apply that shifted the drives by this share of the zero offsets, as journal and history hold it."""
    number = store.create(asked("R1", "apply", of=run), ROBOT)
    zeros = [zero.value_deg or 0.0 for zero in store.calibration(run).zero_offsets]
    for joint, (home, zero) in enumerate(zip((0.0, 180.0), zeros, strict=True), start=1):
        write = store.begin_zero_write(number, joint, zero, home)
        store.end_zero_write(write, home + share * zero)
    _, result = carried_out(
        SimulatedMachine(ROBOT, TRUTH, "exact", 9),
        RUN_KINDS["calibrate"].procedure(  # type: ignore[misc]
            Start(store, asked("R1", "full"), ROBOT)
        ),
        samples=5,
    )
    store.finish(number, State.SUCCEEDED, result.model_copy(update={"verdict": verdict, "accuracy": None}))
    return number


def test_of_an_apply_it_is_what_the_drives_hold(store: Store, tmp_path: Path) -> None:
    store.backup(tmp_path / "station.db")
    with closing(Store(tmp_path / "station.db")) as copy:
        of = error_map(copy, 1, JOINTS)
        whole = error_map(copy, applied(copy, 1, 1.0, "pass"), JOINTS)
        # one that was taken back by half leaves half
        half = error_map(copy, applied(copy, 1, -0.5, "fail"), JOINTS)
    assert values(whole.before_mm) == pytest.approx(values(of.before_mm), abs=1e-5)
    assert values(whole.after_mm) == pytest.approx(values(of.after_mm), abs=1e-5)
    assert whole.bound_95_mm == pytest.approx(of.bound_95_mm, abs=1e-5)
    assert values(half.after_mm) == pytest.approx(0.5 * values(of.before_mm), rel=0.1)
    assert half.fresh == ()


def test_runs_without_zero_offsets_have_none(store: Store, tmp_path: Path) -> None:
    store.backup(tmp_path / "station.db")
    with closing(Store(tmp_path / "station.db")) as copy:
        aborted = copy.create(asked("R1", "full"), ROBOT)
        copy.finish(aborted, State.ABORTED, None)
        retract = copy.create(asked("R1", "retract"), ROBOT)
        for run in (aborted, retract):
            with pytest.raises(NotApplicable, match=f"^Run {run} has no error map: it identified no zero"):
                error_map(copy, run, JOINTS)
        with pytest.raises(NotFound):
            error_map(copy, 99, JOINTS)


def test_machines_drawn_from_the_tolerances_keep_it() -> None:
    """30 machines, six readings and one angle each; at every place, and everywhere at once."""
    robot = robot_of(0.03)
    stops, places = make_plan("rapid", robot).stops, robot.workspace_grid(9, 5)
    kept, alone = [], []
    for seed in range(30):
        machine, rng = drawn(robot, seed)
        seen_deg = float(np.degrees(machine.truth[0]) + rng.normal(0.0, 0.005))
        informed = robot.informed([JointAngle(joint=1, at_deg=0.0, reads_deg=seen_deg, sd_deg=0.005)])
        fit = identify(informed, machine.machine().measure(stops))
        fields = error_fields(fit, fit.dtheta, places)
        true = np.abs(
            true_positions(robot, machine.truth, inverse(robot.geometry, places) - fit.dtheta) - places
        )
        kept.append(true <= fields.within(bounds_mm(fit)[0]))
        alone.append(true <= fields.after_95)
    assert 0.9 < np.mean(alone) < 0.99
    assert np.mean(kept) >= 0.93
    assert np.mean(np.all(kept, axis=1)) >= 0.83


def test_bounds_of_places_are_in_proportion() -> None:
    fields = ErrorFields(np.zeros(3), np.zeros(3), np.array([1.0, np.nan, 2.0]))
    assert fields.within(2.2) == pytest.approx([1.1, np.nan, 2.2], nan_ok=True)
