"""The noise level of the readings: its shape is specified; its level is not known exactly and is averaged."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from station.fitting import pure_error
from station.five_bar import SCALE_SD_MM, FiveBar
from station.records import Real

LEVELS = np.geomspace(0.6, 12.0, 48)
"""Noise over the specification."""
USUAL_SD, POOR_SD = 0.07, 0.5
"""Standard deviations of the logarithm of the level: most stations, and those with a poor head."""
POOR_SHARE, POOR_LEVEL = 0.1, 1.2


def _log_prior() -> Real:
    at = np.log(LEVELS)
    usual = np.exp(-0.5 * (at / USUAL_SD) ** 2) / USUAL_SD
    poor = np.exp(-0.5 * ((at - np.log(POOR_LEVEL)) / POOR_SD) ** 2) / POOR_SD
    prior = (1.0 - POOR_SHARE) * usual + POOR_SHARE * poor
    return np.asarray(np.log(prior / prior.sum()))


LOG_PRIOR = _log_prior()
LOUD = 1.6
"""Scatter of the repeats over that of the head, above which the feedback is not exact."""
WANDERING = 1.5
"""von Neumann's ratio of their deviations below which they drift instead."""
FEWEST = 8


class NoiseLevel:
    """Marginal likelihood of a quadratic form q of N whitened rows; parameters used `taken` of them."""

    def __init__(self, rows: int, taken: float) -> None:
        self._dof = rows - taken

    def __call__(self, q: Real) -> Real:
        """log of the mean over levels s of s^-dof exp(-q / 2 s^2), for q of any shape."""
        grid, value = self._table
        return np.interp(q, grid, value)

    def level(self, q: float) -> float:
        """Posterior mean level at q."""
        weight = self._logs(np.array([q]))[0]
        weight = np.exp(weight - weight.max())
        return float(weight @ LEVELS / weight.sum())

    @cached_property
    def _table(self) -> tuple[Real, Real]:
        grid = np.concatenate([[0.0], np.geomspace(0.05 * self._dof, 1e9, 1500)])
        logs = self._logs(grid)
        peak = logs.max(axis=1)
        return grid, peak + np.log(np.exp(logs - peak[:, None]).sum(axis=1))

    def _logs(self, q: Real) -> Real:
        """(Q, levels)"""
        return np.asarray(LOG_PRIOR - self._dof * np.log(LEVELS) - 0.5 * q[:, None] / LEVELS**2)


def specified(mechanism: FiveBar, residual_mm: Real) -> Real:
    """(K,) standard deviation of the readings, mm: of the head alone where servos stop on whole pulses.

    The feedback of a servo that stops on a pulse is exact; for one that stops between pulses, half a pulse is
    unknown. If the robot file states neither, the scatter of the repeats decides (residual_mm (K,)).
    """
    m = mechanism.measurements
    head = SCALE_SD_MM / np.sqrt(m.samples)
    if mechanism.robot.feedback_sd_deg is not None:
        return mechanism.row_sd
    square, dof = pure_error(m, residual_mm / head)
    if dof < FEWEST or np.sqrt(square / dof) < LOUD:
        return np.asarray(head)
    group = m.repeat_group
    mean = np.bincount(group, residual_mm) / np.bincount(group)
    deviation = (residual_mm - mean[group])[np.argsort(m.t_s, kind="stable")]
    deviation = deviation[deviation != 0.0]
    wandering = np.sum(np.diff(deviation) ** 2) < WANDERING * np.sum(deviation**2)
    return np.asarray(head) if wandering else mechanism.row_sd
