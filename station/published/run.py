"""One calibration by the published method: passes, compensation, stop rule, uncertainty.

The paper prints no uncertainty.  Here the noise of the readings and the tolerances of the geometry that the
four-unknown model omits are propagated through the same matrices to the result.
"""

from __future__ import annotations

import numpy as np

from station.fitting import position_error_summary
from station.five_bar import (
    KEPT,
    MOST_ZERO_OFFSET,
    FiveBar,
    Geometry,
    Robot,
    common_sd_deg,
    distance_jacobian,
    pose,
)
from station.published.method import Identified, compensation_accuracy, identification_matrix, identify
from station.records import (
    LIMIT_SDS,
    Accuracy,
    CalibrationResult,
    Iteration,
    Quantity,
    Reading,
    Real,
    Reason,
    WeakDirection,
    because,
    from_readings,
    phrase,
    residual_rows,
)

MU_0_DEG = 0.1
"""Threshold of eq. 32 (section 6.2)."""
MAX_PASSES = 8
WEAK = phrase("arms_with_sideways", arms=phrase("arms_together"))
"""The direction that this model determines least: its four unknowns contain no other."""
REMEDY = phrase("measure_mounting_or_plan", plan="full")


class PublishedRun:
    """The state between two passes: the results identified and compensated so far."""

    def __init__(self, robot: Robot) -> None:
        self.robot = robot
        self.total: Real = np.zeros(2)
        """(2,) rad, the compensation value of eq. 33."""
        self.drm = 0j
        self.mu_deg: float | None = None
        self._steps: list[Identified] = []
        self._iterations: list[Iteration] = []
        self._readings: list[Reading] = []
        self._raw_rms: float | None = None

    @property
    def converged(self) -> bool:
        return self.mu_deg is not None and self.mu_deg < MU_0_DEG

    def absorb(self, readings: list[Reading]) -> None:
        """Identify from the readings of one pass and add to the compensation (eq. 29, 30, 33)."""
        measurements = from_readings(readings)
        geometry = self.robot.geometry
        if self._raw_rms is None:
            misfit = measurements.distance - pose(geometry, measurements.theta).rho
            self._raw_rms = float(np.std(misfit))
        step = identify(geometry, measurements.theta + self.total, measurements.distance, self.drm)
        self.total = self.total + step.dtheta
        self.drm += step.drm
        if self._steps:
            self.mu_deg = float(np.degrees(compensation_accuracy(step.dtheta, self._steps[-1].dtheta)))
        self._steps.append(step)
        self._readings = readings
        increment, total = np.degrees(step.dtheta), np.degrees(self.total)
        self._iterations.append(
            Iteration(
                number=len(self._steps),
                dtheta1_deg=float(increment[0]),
                dtheta2_deg=float(increment[1]),
                total1_deg=float(total[0]),
                total2_deg=float(total[1]),
                mu_deg=self.mu_deg,
                condition=step.condition,
            )
        )

    def predicted(self, fresh: list[Reading]) -> tuple[Real, Real]:
        """Fresh readings less the prediction of the fixed result (K,), mm, and its covariance (K, K), mm^2.

        The readings were not used before: the covariance contains their own noise, the noise of the last
        pass, and the geometric deviations, which act on both equally.
        """
        mechanism = FiveBar(self.robot, from_readings(self._readings))
        fresh_mechanism = FiveBar(self.robot, from_readings(fresh))
        geometry = self.robot.geometry
        known = Geometry(geometry.e, geometry.L, geometry.l, geometry.cd + self.drm)
        errors: list[Real] = []
        residuals: list[Real] = []
        step = self._steps[-1]
        tolerance = np.array([q.prior_sd for q in mechanism.parameters[2:10]])
        leaked = np.zeros(0)
        for m, noise in ((mechanism, np.diag(mechanism.row_sd)), (fresh_mechanism, None)):
            theta = m.theta + self.total
            jacobian = distance_jacobian(geometry, pose(geometry, theta))
            rows = len(theta)
            own = np.zeros((rows, len(mechanism.theta))) if noise is None else noise
            columns = np.hstack([own, jacobian[:, 2:10] * tolerance])
            if noise is not None:
                leaked = step.gain @ columns
            errors.append(columns - jacobian[:, KEPT] @ leaked)
            residuals.append(m.measurements.distance - pose(known, theta).rho)
        residual = residuals[1] - residuals[0].mean()
        error = errors[1] - errors[0].mean(axis=0)
        return residual, error @ error.T + np.diag(fresh_mechanism.row_sd**2)

    def result(self) -> CalibrationResult:
        """Zero offsets with uncertainty, before and after; not verified yet, so never a pass."""
        measurements = from_readings(self._readings)
        mechanism = FiveBar(self.robot, measurements)
        p = np.array([q.prior_mean for q in mechanism.parameters])
        p[:2], p[10], p[11] = self.total, self.drm.real, self.drm.imag
        spread, reading_sd = self._propagate(mechanism)
        covariance = spread @ spread.T
        geometry = self.robot.geometry
        known = Geometry(geometry.e, geometry.L, geometry.l, geometry.cd + self.drm)
        residual = measurements.distance - pose(known, measurements.theta + self.total).rho
        residual -= residual.mean()
        limit = LIMIT_SDS * reading_sd
        sd = np.sqrt(np.diag(covariance))
        misfit = self._misfit(residual, limit)
        fault = self._fault(residual, sd, mechanism)
        before, jacobian = mechanism.position_errors(p)
        compensated = p.copy()
        compensated[:2] = 0.0
        after, after_jacobian = mechanism.position_errors(compensated)
        matrix = identification_matrix(geometry, measurements.theta + self.total, self.drm)
        sigma = np.linalg.svd(matrix, compute_uv=False)
        return CalibrationResult(
            verdict="fail",
            outcome="failed" if fault else "unexplained" if misfit else "not_verified",
            reason=fault or misfit or because("not_verified"),
            method="published",
            zero_offsets=tuple(
                Quantity(f"dtheta{i + 1}", float(np.degrees(self.total[i])), float(np.degrees(sd[i])), "deg")
                for i in range(2)
            ),
            parameters=(
                Quantity("rMx", self.drm.real, float(sd[10]), "mm"),
                Quantity("rMy", self.drm.imag, float(sd[11]), "mm"),
            ),
            weak_direction=WeakDirection(
                singular_ratio=float(sigma[-1] / sigma[0]),
                text=WEAK.text(),
                said=WEAK,
                sd_deg=common_sd_deg(covariance),
                remedy=REMEDY.text(),
                remedy_said=REMEDY,
            ),
            before=Accuracy(
                reading_rms_mm=self._raw_rms,
                predicted_position_error_mm=position_error_summary(before, jacobian, covariance),
            ),
            after=Accuracy(
                reading_rms_mm=float(np.sqrt(np.mean(residual**2))),
                predicted_position_error_mm=position_error_summary(after, after_jacobian, covariance),
            ),
            iterations=tuple(self._iterations),
            residuals=residual_rows(self._readings, residual, limit),
            lack_of_fit=misfit.text if misfit else None,
            lack_of_fit_reason=misfit,
        )

    def _propagate(self, mechanism: FiveBar) -> tuple[Real, Real]:
        """Root of the covariance of all parameters (P, K + 8), and the sd of each residual (K,).

        Columns are unit normals: the K readings' noise, then the eight geometric deviations, which the
        four-unknown model takes to be zero and which therefore leak into its unknowns.
        """
        step = self._steps[-1]
        theta = mechanism.theta + self.total
        geometry = self.robot.geometry
        jacobian = distance_jacobian(geometry, pose(geometry, theta))
        tolerance = np.array([q.prior_sd for q in mechanism.parameters[2:10]])
        readings = np.hstack([np.diag(mechanism.row_sd), jacobian[:, 2:10] * tolerance])
        spread = np.zeros((len(mechanism.parameters), readings.shape[1]))
        leaked = step.gain @ readings
        spread[list(KEPT)] = leaked
        spread[2:10, -8:] = np.diag(tolerance)
        explained = jacobian[:, KEPT] @ leaked
        left = readings - explained
        left -= left.mean(axis=0)
        return spread, np.sqrt(np.sum(left**2, axis=1))

    def _fault(self, residual: Real, sd: Real, mechanism: FiveBar) -> Reason | None:
        """Why the passes failed; None if they converged to possible numbers."""
        if not self.converged:
            return self._not_settled(mechanism)
        if not (np.isfinite(sd[:2]).all() and np.isfinite(self.total).all() and np.isfinite(residual).all()):
            return because("not_finite")
        beyond = float(np.degrees(np.abs(self.total)).max())
        if beyond > MOST_ZERO_OFFSET * self.robot.tolerances.zero_offset_deg:
            return because("offset_impossible", offset_deg=beyond)
        return None

    def _not_settled(self, mechanism: FiveBar) -> Reason:
        """The readout step as the cause, if it alone moves mu (eq. 32) near its threshold."""
        by_noise = self._steps[-1].gain[:2] * mechanism.row_sd
        scatter_deg = float(np.degrees(np.sqrt(np.sum(by_noise**2))))  # RMS of the difference of two passes
        step_mm = mechanism.measurements.resolution_mm
        passes = len(self._steps)
        if not step_mm or scatter_deg < MU_0_DEG / 2:
            return because("mu_too_large", limit_deg=MU_0_DEG, passes=passes)
        return because(
            "readout_too_coarse",
            limit_deg=MU_0_DEG,
            passes=passes,
            step_um=step_mm * 1e3,
            scatter_deg=scatter_deg,
        )

    def _misfit(self, residual: Real, limit: Real) -> Reason | None:
        """The reading with the largest residual, if it is beyond its limit."""
        worst = int(np.argmax(np.abs(residual) / limit))
        if abs(residual[worst]) <= limit[worst]:
            return None
        return because(
            "reading_beyond_limit",
            reading=self._readings[worst].reading,
            position=self._readings[worst].position,
            residual_um=float(residual[worst]) * 1e3,
            limit_um=float(limit[worst]) * 1e3,
        )
