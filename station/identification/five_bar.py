"""Identification at the limit of the data: one fit of the measurement model, with everything said about it.

The same function serves the browser, REST and a file.  In: a robot, readings, optionally what
earlier runs know (`memory`).  Out: parameters with uncertainty, residuals, noise, lack of fit.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from station.errors import InputRefused
from station.fitting import (
    Noise,
    NotConvergedError,
    Outlier,
    Prior,
    Solution,
    check_outlier_share,
    estimate_noise,
    find_outliers,
    lack_of_fit,
    position_error_field,
    position_error_summary,
    solve,
    tolerance_prior,
)
from station.five_bar import GRID, FiveBar, Robot, check_distances, check_places, check_poses
from station.identification.memory import FORGOTTEN, GATE_P, Memory, contradiction_p
from station.identification.weak_direction import describe_weak_direction
from station.records import Measurements, Quantity, Real, vars_of

LACK_OF_FIT_P = 1e-3
IMPOSSIBLE_SDS = 20.0
"""A parameter this many tolerances from nominal is a wrong file or a missing effect, not a calibration."""


@dataclass(frozen=True, slots=True)
class MemoryUse:
    """Whether what earlier calibrations know took part, and how well the readings agree with it."""

    used: bool
    p_value: float

    def as_json(self) -> dict[str, Any]:
        text = (
            "geometry and mechanism as earlier calibrations found them"
            if self.used
            else "dropped: the readings contradict it; was the mechanism mounted anew?"
        )
        return {"used": self.used, "p_value": self.p_value, "text": text}


@dataclass(frozen=True)
class Identification:
    """One converged fit of the measurement model."""

    mechanism: FiveBar
    measurements: Measurements
    """The readings that took part; outliers are gone."""
    solution: Solution
    noise: Noise
    sd_factor: float
    """What the posterior covariance was inflated by because the model does not fit (1 when it does)."""
    lack_of_fit_p: float
    outliers: tuple[Outlier, ...]
    memory: MemoryUse | None
    """None when there was none."""

    @property
    def p(self) -> Real:
        """(P,) identified parameters, mm and rad."""
        return self.solution.x

    @property
    def covariance(self) -> Real:
        """(P, P) posterior covariance, inflated when the model does not fit."""
        return self.solution.covariance * self.sd_factor**2

    @property
    def dtheta(self) -> Real:
        """(2,) zero offsets, rad."""
        return self.p[:2]

    @property
    def residual_mm(self) -> Real:
        """(K,) measured less predicted."""
        return -self.solution.residual * self.noise.row_sd

    @property
    def adequate(self) -> bool:
        return self.lack_of_fit_p >= LACK_OF_FIT_P

    def moved(self, shift_deg: tuple[float, float]) -> Identification:
        """The same machine seen from drives whose frames have moved: theta before = theta now + shift."""
        x = self.p.copy()
        x[:2] += np.radians(shift_deg)
        return replace(self, solution=replace(self.solution, x=x))

    def quantities(self) -> tuple[Quantity, ...]:
        """Every parameter in shown units with its standard uncertainty."""
        sd = np.sqrt(np.diag(self.covariance))
        return tuple(
            Quantity(p.name, float(x * p.shown), float(s * p.shown), p.unit)
            for p, x, s in zip(self.mechanism.parameters, self.p, sd, strict=True)
        )

    def modes(self) -> tuple[Quantity, Quantity]:
        """Common and differential mode: half the sum and half the difference of the zero offsets."""
        turn = np.array([[0.5, 0.5], [0.5, -0.5]])
        value = np.degrees(turn @ self.dtheta)
        sd = np.degrees(np.sqrt(np.diag(turn @ self.covariance[:2, :2] @ turn.T)))
        return (
            Quantity("common", float(value[0]), float(sd[0]), "deg"),
            Quantity("differential", float(value[1]), float(sd[1]), "deg"),
        )

    def position_error(self, compensated: bool) -> dict[str, float]:
        """Predicted position error over the workspace, mm: rms and largest of the grid.

        Uncompensated: the identified error itself with its uncertainty.  Compensated: the zero
        offsets taken out exactly as identified; the rest of the geometry stays as it is.
        """
        p = self.p.copy()
        if compensated:
            p[:2] = 0.0
        mean, jacobian = self.mechanism.position_errors(p)
        return position_error_summary(mean, jacobian, self.covariance)

    def position_error_map(self) -> list[dict[str, float]]:
        """Predicted position error at each place of the workspace, mm, before and after compensation."""
        fields = []
        for compensated in (False, True):
            p = self.p.copy()
            if compensated:
                p[:2] = 0.0
            mean, jacobian = self.mechanism.position_errors(p)
            fields.append(position_error_field(mean, jacobian, self.covariance))
        places = self.mechanism.robot.workspace_grid(*GRID)
        return [
            {"x_mm": float(r.real), "y_mm": float(r.imag), "before_mm": float(b), "after_mm": float(a)}
            for r, b, a in zip(places, *fields, strict=True)
        ]

    def as_json(self) -> dict[str, Any]:
        """What `station identify --json` writes."""
        residual = self.residual_mm
        quantities = self.quantities()
        return {
            "schema": "station.identification/1",
            "method": "measurement model",
            "noise": self.noise.as_json(),
            "zero_offsets": [
                {"joint": i + 1, "value_deg": q.value, "sd_deg": q.sd} for i, q in enumerate(quantities[:2])
            ],
            "modes": [vars_of(q) for q in self.modes()],
            "parameters": [vars_of(q) for q in quantities],
            "coverage_factor": self.noise.coverage_factor,
            "weak_direction": describe_weak_direction(self),
            "singular_values": [float(s) for s in self.solution.singular_values],
            "residual": {
                "rms_mm": float(np.sqrt(np.mean(residual**2))),
                "max_mm": float(np.abs(residual).max()),
                "lack_of_fit_p": self.lack_of_fit_p,
                "adequate": self.adequate,
            },
            "before": {"predicted_position_error_mm": self.position_error(False)},
            "after": {"predicted_position_error_mm": self.position_error(True)},
            "position_error_map": self.position_error_map(),
            "outliers": [o.as_json() for o in self.outliers],
            "memory": self.memory.as_json() if self.memory else None,
            "convergence": {"steps": self.solution.steps},
        }


def identify(robot: Robot, measurements: Measurements, memory: Memory | None = None) -> Identification:
    """Fit the measurement model to readings, outlying ones found, named and left out.

    `memory`, already aged, is what earlier calibrations of this robot and mechanism know; readings that
    contradict it drop it.

    :raises InputRefused: poses that cannot be, too few places, too many outliers, no convergence,
        or an impossible result, with the reading or parameter at fault.
    """
    check_poses(robot, measurements)
    check_places(measurements)
    check_distances(robot, measurements)
    kept, left_out = _without_outliers(robot, measurements)
    mechanism = FiveBar(robot, kept)
    prior = tolerance_prior(mechanism)
    fit = _fit(mechanism, kept, prior, left_out)
    if memory is not None:
        remembered = memory.prior(mechanism.parameters)
        with_memory = _fit(mechanism, kept, remembered, left_out)
        p_value = contradiction_p(with_memory.solution, remembered, mechanism.parameters)
        if p_value < GATE_P:
            fit = replace(fit, memory=MemoryUse(False, p_value))
        else:
            fit = replace(with_memory, memory=MemoryUse(True, p_value))
    _check_possible(fit)
    return fit


def _fit(
    mechanism: FiveBar, kept: Measurements, prior: Prior, left_out: tuple[Outlier, ...]
) -> Identification:
    row_sd = mechanism.row_sd
    solution = _solve(mechanism, prior, row_sd)
    estimate = estimate_noise(kept, solution.residual, row_sd)
    if estimate.source == "repeats":
        solution = _solve(mechanism, prior, estimate.row_sd)
    p_value, ratio = lack_of_fit(solution, estimate, prior.free, kept)
    return Identification(
        mechanism=mechanism,
        measurements=kept,
        solution=solution,
        noise=estimate,
        sd_factor=ratio if p_value < LACK_OF_FIT_P else 1.0,
        lack_of_fit_p=p_value,
        outliers=left_out,
        memory=None,
    )


def _without_outliers(robot: Robot, measurements: Measurements) -> tuple[Measurements, tuple[Outlier, ...]]:
    mechanism = FiveBar(robot, measurements)
    prior = tolerance_prior(mechanism)
    found = find_outliers(mechanism, lambda sd: _solve(mechanism, prior, sd), mechanism.row_sd)
    check_outlier_share(found, len(measurements))
    if not found:
        return measurements, ()
    named = {o.reading for o in found}
    kept = measurements.take(np.array([i not in named for i in measurements.ids]))
    check_places(kept)
    return kept, found


def _solve(mechanism: FiveBar, prior: Prior, row_sd: Real) -> Solution:
    theta, measured = mechanism.theta, mechanism.measured

    def residuals(p: Real) -> tuple[Real, Real]:
        at = mechanism.observe(p, theta)
        return (at.value - measured) / row_sd, at.by_parameter / row_sd[:, None]

    try:
        return solve(residuals, prior.mean, prior)
    except NotConvergedError as error:
        raise InputRefused(
            f"The identification did not converge ({error}); check that angles and distances belong together."
        ) from error


def _check_possible(fit: Identification) -> None:
    """A link 3 mm off is a wrong robot file or a wrong column, not a calibration.

    :raises InputRefused: naming the parameter.
    """
    parameters = fit.mechanism.parameters
    offset = np.array([abs(x - p.prior_mean) / p.prior_sd for x, p in zip(fit.p, parameters, strict=True)])
    worst = int(np.argmax(offset))
    beyond_zero = np.degrees(np.abs(fit.dtheta)) > 4.0 * fit.mechanism.robot.tolerances.zero_offset_deg
    if offset[worst] > IMPOSSIBLE_SDS or beyond_zero.any():
        p = parameters[worst]
        raise InputRefused(
            f"Impossible result: {p.name} would be {fit.p[worst] * p.shown:.3f} {p.unit}, "
            f"{offset[worst]:.0f} times its tolerance; check the robot file and the readings' columns, "
            "then run the diagnosis."
        )


def memory_of(fit: Identification) -> Memory:
    """What a calibration leaves to the next one."""
    names = [p.name for p in fit.mechanism.parameters]
    kept = [i for i, name in enumerate(names) if name.split("@")[0] not in FORGOTTEN]
    return Memory(tuple(names[i] for i in kept), fit.p[kept], fit.covariance[np.ix_(kept, kept)])
