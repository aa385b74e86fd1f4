"""What an earlier calibration knows: used when it holds, dropped when the readings contradict it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from station.five_bar.mechanism import FiveBar
from station.five_bar.robot_file import Robot
from station.identification import gate_record
from station.identification.estimate import Identification, identify
from station.identification.memory import Memory
from station.published.method import boundary_positions
from station.records import LastingParameters
from tests.station.simulated import group, measure

ROBOT = replace(Robot.default(), feedback_sd_deg=0.0)
"""Joints that stand on whole pulses, as these simulated ones do."""
PLACES = boundary_positions(ROBOT.workspace_x, ROBOT.workspace_y, 3)


def learned(seed: int) -> tuple[np.ndarray, Memory]:
    truth = group(1)
    fit = identify(ROBOT, measure(ROBOT, truth, ROBOT.workspace_grid(6, 4), seed, 5))
    return truth, fit.lasting


def six_readings(truth: np.ndarray, memory: Memory | None) -> Identification[FiveBar]:
    return identify(ROBOT, measure(ROBOT, truth, PLACES, 7), memory)


def test_geometry_and_mechanism_are_kept_and_zero_offsets_are_not() -> None:
    _, memory = learned(0)
    assert not {"dtheta1", "dtheta2", "rho0"} & set(memory.names)
    assert len(memory.names) == 10


def test_six_readings_with_memory_are_surer_and_still_right() -> None:
    truth, memory = learned(0)
    truth[:2] = np.radians([-1.5, 2.5])
    alone, remembering = six_readings(truth, None), six_readings(truth, memory)
    assert remembering.gate is not None
    assert remembering.gate.used
    sd = [q.sd for q in remembering.quantities()[:2]]
    assert sd < [0.75 * q.sd for q in alone.quantities()[:2]]
    assert (np.abs(np.degrees(remembering.dtheta - truth[:2])) < 3 * np.array(sd)).all()


@pytest.mark.parametrize("seed", range(3))
def test_a_mechanism_mounted_anew_drops_the_memory(seed: int) -> None:
    truth, memory = learned(seed)
    turn = np.random.default_rng(seed).uniform(0, 2 * np.pi)
    truth[10:12] += np.cos(turn), np.sin(turn)
    fit = six_readings(truth, memory)
    assert fit.gate is not None
    assert not fit.gate.used
    assert "not used" in gate_record(fit.gate).text
    assert fit.p == pytest.approx(six_readings(truth, None).p)


def test_age_makes_less_sure() -> None:
    truth, memory = learned(0)
    parameters = FiveBar(ROBOT, measure(ROBOT, truth, PLACES, 0)).parameters
    young, old = memory.aged(parameters, 0.0), memory.aged(parameters, 10.0)
    assert np.diag(young.covariance) == pytest.approx(np.diag(memory.covariance))
    assert (np.diag(old.covariance) > np.diag(memory.covariance)).all()


def test_a_memory_survives_the_way_to_json_and_back() -> None:
    _, memory = learned(0)
    back = Memory.of(LastingParameters.model_validate_json(memory.record().model_dump_json()))
    assert back.names == memory.names
    assert back.covariance == pytest.approx(memory.covariance)
