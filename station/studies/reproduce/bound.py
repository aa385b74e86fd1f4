"""The bound beside each figure: what the same readings and priors allow (`DEFINITION`)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from station.fitting import Prior, tolerance_prior
from station.five_bar import FiveBar
from station.identification import Memory
from station.records import Measurements, Real
from station.studies.reproduce.trial import (
    FULL,
    FULL_DRM,
    KNOWN_DRM_SD_MM,
    RAPID,
    RAPID_DRM,
    RAPID_MEMORY,
    Conditions,
    stops_of,
)

SAMPLES = 4000
DEFINITION = (
    "The errors of the machine are fixed and the model is linearised about them. The Bayes estimator of the "
    "linear model with normal noise, whose covariance is the Cramer-Rao bound with prior, is sampled: its "
    "error is C (J' z + W (m - p)), J the whitened Jacobian, z standard normal noise, W the information and "
    "m the mean of the prior, p the true errors, C = (J' J + W)^-1; so the prior pulls it as it pulls any "
    "estimator that uses it. For a memory both runs are sampled in turn. The bound is the median of the "
    "largest position error over the workspace, to first order."
)


@dataclass(frozen=True)
class _Linear:
    """A calibration to first order about the truth."""

    mechanism: FiveBar
    truth: Real
    """(P,)"""

    @classmethod
    def of(cls, conditions: Conditions, measurements: Measurements, truth: Real) -> _Linear:
        mechanism = FiveBar(conditions.robot, measurements)
        return cls(mechanism, np.append(truth, 0.0))

    def errors(self, prior: Prior, prior_error: Real, rng: np.random.Generator) -> tuple[Real, Real]:
        """(N, P) errors of the estimator whose prior means are off by prior_error (N, P); and C (P, P)."""
        at = self.mechanism.observe(self.truth, self.mechanism.theta)
        J = at.by_parameter / self.mechanism.row_sd[:, None]
        information = prior.root.T @ prior.root
        covariance = np.linalg.inv(J.T @ J + information)
        noise = rng.normal(size=(len(prior_error), len(J)))
        return (noise @ J + prior_error @ information) @ covariance, covariance

    def prior_error(self) -> Real:
        """(N, P) of the tolerances' means."""
        mean = self.mechanism.start
        return np.tile(mean - self.truth, (SAMPLES, 1))

    def largest(self, errors: Real) -> float:
        """Median over samples of the largest position error over the workspace, mm."""
        jacobian = self.mechanism.position_errors(self.truth)[1]
        moved = (errors @ jacobian.reshape(-1, errors.shape[1]).T).reshape(len(errors), -1, 2)
        return float(np.median(np.linalg.norm(moved, axis=2).max(axis=1)))


def bounds(conditions: Conditions) -> dict[str, float]:
    """Largest position error by method, mm."""
    rng = np.random.default_rng(conditions.group)
    machine, samples = conditions.machine(0), conditions.samples
    rapid = _Linear.of(conditions, machine.measure(stops_of(conditions, "rapid"), samples), conditions.truth)
    full = _Linear.of(conditions, machine.measure(stops_of(conditions, "full"), samples), conditions.truth)
    careful = _Linear.of(
        conditions, machine.measure(stops_of(conditions, "full", True), samples), conditions.truth
    )
    out = {method: run.largest(_alone(run, rng)) for method, run in ((FULL, full), (RAPID, rapid))}
    out[RAPID_MEMORY] = rapid.largest(_remembering(conditions, rapid, rng))
    for method, run in ((FULL_DRM, careful), (RAPID_DRM, rapid)):
        out[method] = run.largest(_mechanism_known(run, rng))
    return out


def _alone(run: _Linear, rng: np.random.Generator) -> Real:
    return run.errors(tolerance_prior(run.mechanism), run.prior_error(), rng)[0]


def _mechanism_known(run: _Linear, rng: np.random.Generator) -> Real:
    robot = run.mechanism.robot.with_mechanism(run.mechanism.robot.drm, (KNOWN_DRM_SD_MM, KNOWN_DRM_SD_MM))
    prior = tolerance_prior(FiveBar(robot, run.mechanism.measurements))
    prior_error = run.prior_error()
    prior_error[:, 10:12] = rng.normal(0.0, KNOWN_DRM_SD_MM, (SAMPLES, 2))
    return run.errors(prior, prior_error, rng)[0]


def _remembering(conditions: Conditions, run: _Linear, rng: np.random.Generator) -> Real:
    """The full run before both zero offsets changed, then six readings with what it left."""
    truth = conditions.earlier_truth
    readings = conditions.machine(1, truth).measure(stops_of(conditions, "full"), conditions.samples)
    earlier = _Linear.of(conditions, readings, truth)
    errors, covariance = earlier.errors(tolerance_prior(earlier.mechanism), earlier.prior_error(), rng)
    parameters = earlier.mechanism.parameters
    lasting = [i for i, p in enumerate(parameters) if p.lasting]
    names = tuple(parameters[i].name for i in lasting)
    memory = Memory(names, run.truth[lasting], covariance[np.ix_(lasting, lasting)])
    prior_error = run.prior_error()
    prior_error[:, lasting] = errors[:, lasting]
    return run.errors(memory.prior(run.mechanism.parameters), prior_error, rng)[0]
