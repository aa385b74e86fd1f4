"""Robots of one type: who teaches whom, what a run says of it, and that it is the same ever after."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from rich.console import Console

from station.errors import NotApplicable
from station.five_bar import Robot
from station.records import Actor, CalibrationRequest
from station.run_kinds import RUN_KINDS, Start
from station.run_kinds.apply import source_of
from station.store import Store
from station.studies.engine import Engine
from station.studies.refit import candidates, refit
from station.studies.simulation import SimulatedMachine
from tests.station.simulated import carried_out, group

ROBOT = Robot(serial="R1", type="T")


def calibrated(store: Store, serial: str, truth: np.ndarray, kind: str | None = "T") -> int:
    """A simulated run, stored as the station stores it."""
    robot = replace(ROBOT, serial=serial, type=kind)
    request = CalibrationRequest(serial, "calibrate", "Ana", plan="rapid")
    procedure = RUN_KINDS["calibrate"].procedure
    assert procedure is not None
    machine = SimulatedMachine(robot, truth, "exact", 7)
    readings, result = carried_out(machine, procedure(Start(store, request, robot)))
    return store.add_run(request, robot, readings, result)


@pytest.fixture
def store(tmp_path: Path) -> Iterator[Store]:
    with closing(Store(tmp_path / "station.db")) as store:
        yield store


def test_others_of_the_type_teach_and_the_result_says_so(store: Store, tmp_path: Path) -> None:
    calibrated(store, "R1", group(1))
    calibrated(store, "R2", group(2))
    alone = calibrated(store, "R3", group(1), kind=None)
    third = calibrated(store, "R4", group(3))
    assert store.calibration(alone).fleet is None
    said = store.calibration(third).fleet
    assert said is not None
    assert said.used
    assert said.prior.serials == ("R1", "R2")
    assert said.text == "the geometry of 2 other robots of type T"
    # its own run counts from now on, and what it had started from goes along
    again = store.calibration(calibrated(store, "R4", group(3)))
    assert again.fleet is None
    assert again.memory is not None
    left = store.memory("R4")
    assert left is not None
    assert left.memory.fleet == said.prior
    # and the fit is the same ever after
    fit = source_of(store, third).fit
    zeros = [zero.value_deg for zero in store.calibration(third).zero_offsets]
    assert np.degrees(fit.dtheta) == pytest.approx(zeros, abs=1e-9)
    store.close()
    with closing(Store(tmp_path / "station.db", read_only=True)) as kept:
        runs = candidates(kept)
    assert refit(tmp_path / "station.db", runs, Engine(Console(quiet=True), workers=1)).changed == ()


def test_what_was_forgotten_teaches_nobody(store: Store) -> None:
    calibrated(store, "R1", group(1))
    assert len(store.others_of_type(replace(ROBOT, serial="R2"))) == 1
    assert store.others_of_type(replace(ROBOT, serial="R2", type="U")) == []
    assert store.others_of_type(replace(ROBOT, serial="R2", L=(376.0, 375.0))) == []
    store.forget("R1", Actor(name="Ana", via="terminal"))
    assert store.others_of_type(replace(ROBOT, serial="R2")) == []


def test_a_robot_of_another_type_is_refused(store: Store) -> None:
    store.save_robot(ROBOT)
    store.save_robot(replace(ROBOT, L=(376.0, 376.0)))
    with pytest.raises(NotApplicable, match="robot R1 of that type has other nominal lengths"):
        store.save_robot(replace(ROBOT, serial="R2"))
    store.save_robot(replace(ROBOT, serial="R2", type="U"))
