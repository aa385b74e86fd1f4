"""Fits under a hypothesis, on machines whose truth is known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from station.diagnosis.mistakes.defects import both_gains, drive_angle
from station.diagnosis.mistakes.fitting import Extra, costs, fit, posterior, rough
from station.five_bar.robot_file import Robot
from station.studies.confusion.spoiling import measured

ROBOT = Robot.default()
SEQUENCE = measured(99).files.sequence


def test_base_fit_leaves_the_heads_noise() -> None:
    found = fit(ROBOT, SEQUENCE)
    assert found is not None
    assert 0.7e-3 < found.rms_mm < 2e-3


def test_a_column_that_is_there_is_found_with_its_size_and_pays_its_price() -> None:
    stepped = replace(
        SEQUENCE, distance=SEQUENCE.distance + np.where(np.arange(len(SEQUENCE)) >= 50, 3.0, 0.0)
    )
    column = Extra("step", 100.0, by_reading=(np.arange(len(SEQUENCE)) >= 50).astype(float))
    found, without = fit(ROBOT, stepped, extras=(column,)), fit(ROBOT, SEQUENCE)
    assert found is not None and without is not None
    assert found.extra["step"] == pytest.approx(3.0, abs=6 * found.extra_sd["step"] + 1e-3)
    needless = fit(ROBOT, SEQUENCE, extras=(column,))
    assert needless is not None and needless.deviance > without.deviance


def test_a_ratio_is_found() -> None:
    theta = SEQUENCE.theta - 0.01 * drive_angle(ROBOT, SEQUENCE.theta)
    found = fit(ROBOT, replace(SEQUENCE, theta=theta), extras=(both_gains(ROBOT, SEQUENCE, 0.2),))
    assert found is not None
    assert found.extra["gain"] == pytest.approx(0.01, rel=0.03)


def test_rough_fit_goes_with_the_majority() -> None:
    spoiled = SEQUENCE.distance.copy()
    spoiled[:40] += np.linspace(-80.0, 80.0, 40)
    found = rough(ROBOT, replace(SEQUENCE, distance=spoiled))
    assert np.abs(found.residual_mm[40:]).max() < 0.2


def test_costs_of_nothing_and_of_no_residual() -> None:
    nothing, unknown = costs(np.array([0.0, np.nan]))
    assert nothing == 0.0 and unknown > 15.0


def test_posterior_holds_other_readings_to_it() -> None:
    sequence_fit = fit(ROBOT, SEQUENCE)
    assert sequence_fit is not None
    mean, root = posterior(ROBOT, SEQUENCE, sequence_fit)
    sd = np.sqrt(np.diag(np.linalg.inv(root.T @ root)))
    assert mean == pytest.approx(sequence_fit.p)
    assert sd == pytest.approx(sequence_fit.sd, rel=0.3)
