"""Apply and roll back as procedures: what each step asks for, and what each result states."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cache

import numpy as np
import pytest

from drivers.errors import DeviceFault
from station.errors import InputRefused, NotFound, StepFailed
from station.five_bar.robot_file import Robot
from station.identification.estimate import identify
from station.identification.verification import fresh_stops, verify
from station.records import (
    LIMIT_SDS,
    Accuracy,
    Ask,
    CalibrationResult,
    MeasurementSequence,
    Procedure,
    Reading,
    Retract,
    SetZeros,
    State,
    Step,
    from_readings,
)
from station.run_kinds.apply import Source, apply, roll_back, source_of, start_apply, start_roll_back
from station.run_kinds.kind import Start
from station.store.store import Store
from station.studies.simulation import SimulatedMachine
from tests.station.asking import asked, start_procedure
from tests.station.simulated import carried_out, group, measure, read

ROBOT = replace(Robot.default("R1"), feedback_sd_deg=0.0)
OFFSETS_DEG = (2.0, -1.0)
TRUTH = group(1)


@cache
def source() -> Source:
    """A calibration, number 7, of a machine whose offsets are those of Table 2's group 1."""
    fit = identify(ROBOT, measure(ROBOT, TRUTH, ROBOT.workspace_grid(5, 3), 0, repeats=3))
    first, second = (float(np.degrees(angle)) for angle in fit.dtheta)
    return Source(7, fit, (first, second))


@dataclass
class Drives:
    """A machine whose drives take the zeros they are given."""

    offsets_deg: tuple[float, float] = OFFSETS_DEG
    steps: list[MeasurementSequence | SetZeros] = field(default_factory=list)
    readings: list[Reading] = field(default_factory=list)
    refuses: list[Exception] = field(default_factory=list)
    """Of the next zeros to be set, one each."""
    disturb: Callable[[Reading], Reading] = lambda reading: reading

    def carry_out(self, procedure: Procedure) -> CalibrationResult:
        try:
            step = next(procedure)
            while True:
                assert not isinstance(step, Retract | Ask)
                self.steps.append(step)
                if isinstance(step, MeasurementSequence):
                    step = procedure.send(self._read(step))
                elif self.refuses:
                    step = procedure.throw(self.refuses.pop(0))
                else:
                    step = procedure.send(self._set(step))
        except StopIteration as end:
            result: CalibrationResult = end.value
            return result

    def _read(self, sequence: MeasurementSequence) -> list[Reading]:
        truth = TRUTH.copy()
        truth[:2] = np.radians(self.offsets_deg)
        machine = SimulatedMachine(ROBOT, truth, "exact", 1 + len(self.steps))
        # the readout was switched off in between
        self.readings = [
            self.disturb(replace(reading, scale_mm=reading.scale_mm + 200.0))
            for reading in read(machine, sequence, before=40)
        ]
        return self.readings

    def _set(self, step: SetZeros) -> tuple[float, float]:
        """The shift since the calibration: theta before = theta now + shift."""
        first, second = (old - taken for old, taken in zip(OFFSETS_DEG, step.offsets_deg, strict=True))
        self.offsets_deg = (first, second)
        return -step.offsets_deg[0], -step.offsets_deg[1]


def stated(step: Step) -> tuple[str, int, tuple[str, ...] | tuple[int, tuple[float, float]]]:
    if isinstance(step, MeasurementSequence):
        return step.title, step.number, tuple(stop.position for stop in step.stops)
    assert isinstance(step, SetZeros)
    return step.title, step.number, (step.of, step.offsets_deg)


CHECK = ("Checking the machine", 1, ("C1", "C2", "C3", "C4"))
VERIFY = ("Verifying at fresh positions", 3, tuple(f"V{k}" for k in range(1, 9)))
BACK = ("Rolling back", 2, (7, (0.0, 0.0)))
WAY_BACK = ("Rolling back", 4, (7, (0.0, 0.0)))


def written() -> tuple[str, int, tuple[int, tuple[float, float]]]:
    return "Writing the zero offsets", 2, (7, source().offsets_deg)


def assert_states(result: CalibrationResult, shift: tuple[float, float], readings: list[Reading]) -> None:
    """The numbers of the frozen model, seen from drives whose frames have moved by `shift` (deg)."""
    fit = source().fit
    moved = fit.moved(shift)
    known = fit.quantities()
    assert result.method == "zero offsets of run 7"
    assert [q.name for q in result.zero_offsets] == ["dtheta1", "dtheta2"]
    for zero, before, by in zip(result.zero_offsets, known, shift, strict=False):
        assert zero.value == pytest.approx(before.value + by, abs=1e-9)
        assert zero.sd == before.sd
    assert result.parameters == known[2:]
    assert result.weak_direction == moved.weak_direction
    assert result.before == Accuracy(predicted_position_error_mm=fit.position_error(compensated=False))
    assert result.after is not None
    assert result.after.predicted_position_error_mm == moved.position_error(compensated=False)
    if not readings:
        assert result.after.reading_rms_mm is None
        assert result.residuals == ()
        return
    check = verify(moved, from_readings(readings), offset_known=False)
    assert result.after.reading_rms_mm == pytest.approx(float(np.sqrt(np.mean(check.residual_mm**2))))
    assert [row.reading for row in result.residuals] == [r.reading for r in readings]
    assert [row.residual_mm for row in result.residuals] == pytest.approx(check.residual_mm.tolist())
    assert [row.limit_mm for row in result.residuals] == pytest.approx((LIMIT_SDS * check.sd_mm).tolist())


def test_an_apply_checks_writes_and_verifies_at_other_places() -> None:
    drives = Drives()
    result = drives.carry_out(apply(source()))
    assert [stated(step) for step in drives.steps] == [CHECK, written(), VERIFY]
    check, _, verification = drives.steps
    assert isinstance(check, MeasurementSequence) and isinstance(verification, MeasurementSequence)
    assert not {s.target_mm for s in check.stops} & {s.target_mm for s in verification.stops}
    assert (result.verdict, result.outcome, result.reason.code) == ("pass", "good", "verified")
    shift = (-source().offsets_deg[0], -source().offsets_deg[1])
    assert_states(result, shift, drives.readings)
    assert result.after is not None
    assert result.reason.params == {"rms_um": pytest.approx(1e3 * (result.after.reading_rms_mm or 0.0))}
    assert 0.1 < result.reason.params["rms_um"] < 10.0  # type: ignore[operator]
    # new stops are commanded in the frames that the drives have now
    moved = source().fit.moved(shift)
    assert verification.stops == fresh_stops(moved, seed=3)
    assert check.stops == fresh_stops(source().fit, 4, 1, "C")


def test_offsets_of_another_size_are_noticed_before_anything_is_written() -> None:
    drives = Drives(offsets_deg=(2.1, -1.0))
    with pytest.raises(StepFailed) as failed:
        drives.carry_out(apply(source()))
    assert [stated(step) for step in drives.steps] == [CHECK]
    text = str(failed.value)
    assert text.startswith("Nothing was written: the machine is not as run 7 measured it. Fresh readings are")
    assert text.endswith(" µm. Calibrate again.")


def test_a_verification_that_fails_takes_the_zeros_back_and_states_the_old_ones() -> None:
    def disturb(reading: Reading) -> Reading:
        wrong = 0.2 if reading.position == "V3" else 0.0
        return replace(reading, scale_mm=reading.scale_mm + wrong)

    drives = Drives(disturb=disturb)
    result = drives.carry_out(apply(source()))
    assert [stated(step) for step in drives.steps] == [CHECK, written(), VERIFY, WAY_BACK]
    assert (result.verdict, result.outcome, result.reason.code) == (
        "fail",
        "not_verified",
        "rolled_back_after",
    )
    assert "number 3, is off by" in result.reason.text
    assert result.reason.text.endswith("Rolled back; the old zero offsets are in the drives.")
    assert drives.offsets_deg == OFFSETS_DEG
    assert [q.value for q in result.zero_offsets] == pytest.approx(source().offsets_deg)
    assert len(result.residuals) == 8


def test_zeros_that_a_drive_refuses_are_taken_back() -> None:
    drives = Drives(refuses=[DeviceFault("the drive refuses its zero.")])
    with pytest.raises(
        StepFailed, match=r"^the drive refuses its zero\. The old zero offsets are in the drives\.$"
    ):
        drives.carry_out(apply(source()))
    assert [stated(step) for step in drives.steps] == [CHECK, written(), WAY_BACK]


def test_a_way_back_that_fails_names_both_troubles() -> None:
    drives = Drives(refuses=[DeviceFault("the drive refuses its zero."), StepFailed("not reached.")])
    with pytest.raises(
        StepFailed, match=r"^the drive refuses its zero\. The way back failed too: not reached\.$"
    ):
        drives.carry_out(apply(source()))
    assert [stated(step) for step in drives.steps] == [CHECK, written(), WAY_BACK]


def test_a_rollback_of_what_was_never_verified_measures_nothing() -> None:
    drives = Drives()
    result = drives.carry_out(roll_back(source(), None))
    assert [stated(step) for step in drives.steps] == [BACK]
    assert (result.verdict, result.outcome) == ("pass", "good")
    assert (result.reason.code, result.reason.params) == ("rolled_back", {})
    assert_states(result, (0.0, 0.0), [])


def test_a_rollback_of_what_was_verified_checks_the_drives_first() -> None:
    offsets = source().offsets_deg
    drives = Drives(offsets_deg=(OFFSETS_DEG[0] - offsets[0], OFFSETS_DEG[1] - offsets[1]))
    result = drives.carry_out(roll_back(source(), (-offsets[0], -offsets[1])))
    assert [stated(step) for step in drives.steps] == [CHECK, BACK]
    assert (result.verdict, result.outcome, result.reason.code) == ("pass", "good", "rolled_back")
    assert [row.reading for row in result.residuals] == [r.reading for r in drives.readings]
    # the check was made under the zeros of then
    check = verify(
        source().fit.moved((-offsets[0], -offsets[1])), from_readings(drives.readings), offset_known=False
    )
    assert [row.residual_mm for row in result.residuals] == pytest.approx(check.residual_mm.tolist())
    assert [q.value for q in result.zero_offsets] == pytest.approx(offsets)


def test_a_rollback_writes_nothing_to_drives_that_are_not_as_they_were_left() -> None:
    drives = Drives(offsets_deg=(0.1, 0.0))
    offsets = source().offsets_deg
    with pytest.raises(StepFailed) as failed:
        drives.carry_out(roll_back(source(), (-offsets[0], -offsets[1])))
    assert [stated(step) for step in drives.steps] == [CHECK]
    text = str(failed.value)
    assert text.startswith("Nothing was written: the drives are not as they were left. Fresh readings are")
    assert text.endswith(" µm. Calibrate again.")


# From the store ----------------------------------------------------------------------------------


def kept(store: Store, plan: str = "rapid") -> int:
    """A calibration measured in virtual time and stored."""
    machine = SimulatedMachine(ROBOT, TRUTH, "exact", 3)
    readings, result = carried_out(machine, start_procedure(plan, ROBOT), samples=5)
    return store.add_run(asked("R1", plan), ROBOT, readings, result)


@pytest.mark.parametrize("plan", ["rapid", "full"])
def test_the_source_is_the_stored_run_fitted_again_without_its_verification(store: Store, plan: str) -> None:
    run = kept(store, plan)
    found = source_of(store, run)
    stored = store.calibration(run)
    assert found.id == run
    assert found.offsets_deg == tuple(zero.value_deg for zero in stored.zero_offsets)
    again = [quantity.value for quantity in found.fit.quantities()[:2]]
    assert again == pytest.approx(found.offsets_deg, rel=1e-5)
    assert [q.sd for q in found.fit.quantities()[:2]] == pytest.approx(
        [zero.sd_deg for zero in stored.zero_offsets], rel=1e-5
    )
    first = [r for r in store.readings(run) if r.sequence == 1]
    assert set(found.fit.measurements.ids) <= {r.reading for r in first}


def test_positions_of_two_passes_are_no_repeats_of_each_other(store: Store) -> None:
    run = kept(store, "paper")
    fit = source_of(store, run).fit
    readings = [r for r in store.readings(run) if not r.position.startswith("V")]
    assert len(fit.measurements) + len(fit.outliers) == len(readings)
    places = {(r.position, r.sequence) for r in readings}
    assert len(set(fit.measurements.position.tolist())) >= len(places) - len(fit.outliers)


def test_a_memory_that_took_part_takes_part_again(store: Store) -> None:
    first = kept(store, "full")
    memory = store.memory("R1")
    assert memory is not None and memory.calibration_id == first
    machine = SimulatedMachine(ROBOT, TRUTH, "exact", 4)
    readings, result = carried_out(machine, start_procedure("rapid", ROBOT, memory), samples=5)
    assert result.memory is not None and result.memory.used
    run = store.add_run(asked("R1", "rapid"), ROBOT, readings, result)
    sd = [quantity.sd for quantity in source_of(store, run).fit.quantities()[:2]]
    assert sd == pytest.approx([zero.sd_deg for zero in store.calibration(run).zero_offsets], rel=1e-4)


def test_a_memory_that_took_part_is_as_old_as_it_was_then(store: Store) -> None:
    kept(store, "full")
    machine = SimulatedMachine(ROBOT, TRUTH, "exact", 4)
    readings, result = carried_out(machine, start_procedure("rapid", ROBOT, store.memory("R1")), samples=5)
    assert result.memory is not None
    sds = []
    for age_days in (0.0, 3000.0):
        memory = result.memory.model_copy(update={"age_days": age_days})
        run = store.add_run(
            asked("R1", "rapid"), ROBOT, readings, result.model_copy(update={"memory": memory})
        )
        # of the mechanism, which an old memory says less about
        sds.append(source_of(store, run).fit.quantities()[10].sd)
    assert sds[1] > 1.2 * sds[0]


def test_a_run_without_offsets_and_one_that_is_not_there_have_no_source(store: Store) -> None:
    machine = SimulatedMachine(ROBOT, TRUTH, "exact", 3)
    readings, result = carried_out(machine, start_procedure("rapid", ROBOT), samples=5)
    run = store.add_run(asked("R1", "rapid"), ROBOT, readings, result.model_copy(update={"zero_offsets": ()}))
    with pytest.raises(InputRefused, match=f"^Run {run} has no zero offsets; calibrate again.$"):
        source_of(store, run)
    with pytest.raises(NotFound, match="99"):
        source_of(store, 99)


def start_of(store: Store, kind: str, run: int) -> Start:
    return Start(store, asked("R1", kind, of=run), ROBOT)


def test_an_apply_starts_from_the_run_that_it_is_about(store: Store) -> None:
    run = kept(store)
    procedure = start_apply(start_of(store, "apply", run))
    assert stated(next(procedure)) == CHECK
    procedure.close()


def applied(store: Store, run: int, verdict: str, shift: tuple[float, float]) -> None:
    """An apply as the journal and the history hold it."""
    number = store.create(asked("R1", "apply", of=run), ROBOT)
    for joint, (home, by) in enumerate(zip((0.0, 180.0), shift, strict=True), start=1):
        write = store.begin_zero_write(number, joint, -by, home + by)
        store.end_zero_write(write, home)
    result = Drives().carry_out(apply(source()))
    store.finish(number, State.SUCCEEDED, result.model_copy(update={"verdict": verdict}))


def test_a_rollback_checks_only_what_an_apply_verified(store: Store) -> None:
    run = kept(store)
    zeros = source_of(store, run).offsets_deg
    applied(store, run, "fail", (-zeros[0], -zeros[1]))
    unverified = start_roll_back(start_of(store, "rollback", run))
    assert stated(next(unverified)) == ("Rolling back", 2, (run, (0.0, 0.0)))
    unverified.close()


def test_a_rollback_checks_the_drives_under_the_zeros_of_the_journal(store: Store) -> None:
    earlier = kept(store)
    applied(store, earlier, "pass", (0.3, 0.3))  # before the run, so none of its shift
    run = kept(store)
    zeros = source_of(store, run).offsets_deg
    applied(store, run, "pass", (-zeros[0], -zeros[1]))
    verified = start_roll_back(start_of(store, "rollback", run))
    sequence = next(verified)
    assert isinstance(sequence, MeasurementSequence)
    assert stated(sequence) == CHECK
    drives = Drives(offsets_deg=(OFFSETS_DEG[0] - zeros[0], OFFSETS_DEG[1] - zeros[1]))
    step = verified.send(drives._read(sequence))
    assert stated(step) == ("Rolling back", 2, (run, (0.0, 0.0)))
    verified.close()
