"""The lasting results of a calibration: geometry and mechanism, as the prior of the machine's next one.

Zero offsets do not last (a collision changes them) and neither does the reading offset, so both are omitted.
The others are widened for their age and tested: if the readings contradict them (the mechanism was
remounted), they are dropped.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace

import numpy as np
from scipy.special import chdtrc, ndtr

from station.fitting import Prior, Solution
from station.five_bar import Robot, measured_value
from station.mechanism import Parameter
from station.records import FleetPrior, LastingParameters, MountingError, Real

WIDENED_PER_ROOT_YEAR = 0.3
"""Share of a parameter's tolerance by which it may have drifted in a year (random walk)."""
GATE_P = 0.02
"""Probability that a correct memory is dropped; that costs accuracy, a wrong one gives wrong results."""
INFORMATIVE = 0.3
"""Directions with less than this share of the memory's information cannot contradict it."""


@dataclass(frozen=True)
class Memory:
    """Posterior of the lasting parameters of one robot and one mechanism."""

    names: tuple[str, ...]
    mean: Real
    """(M,) mm"""
    covariance: Real
    """(M, M)"""
    noise_ratio: float = 1.0
    """Noise of a reading over its specification, determined from repeats."""
    references: tuple[MountingError, ...] = ()
    """Measurements of the mounting that it contains already; each measurement counts once."""
    fleet: FleetPrior | None = None
    """The prior that it started from, where other robots of the type were known."""

    def record(self) -> LastingParameters:
        """The memory as the store contains it."""
        covariance = tuple(tuple(row) for row in self.covariance.tolist())
        return LastingParameters(
            names=self.names,
            mean=tuple(self.mean.tolist()),
            covariance=covariance,
            references=self.references,
            noise_ratio=self.noise_ratio,
            fleet=self.fleet,
        )

    @classmethod
    def of(cls, kept: LastingParameters) -> Memory:
        """The memory from its stored form."""
        mean, covariance = np.array(kept.mean), np.array(kept.covariance)
        return cls(kept.names, mean, covariance, kept.noise_ratio, kept.references, kept.fleet)

    @classmethod
    def of_fleet(cls, prior: FleetPrior) -> Memory:
        """The expectation for a robot that was never measured, from others of its type."""
        return cls(prior.names, np.array(prior.mean), np.array(prior.covariance), fleet=prior)

    def aged(self, parameters: tuple[Parameter, ...], years: float) -> Memory:
        """The same, with more uncertainty for changes since."""
        tolerance = {p.name: p.prior_sd for p in parameters}
        wander = np.array([tolerance.get(name, 0.0) for name in self.names]) * WIDENED_PER_ROOT_YEAR
        wider = self.covariance + np.diag(wander**2 * max(years, 0.0))
        return replace(self, covariance=wider)

    def informed(self, robot: Robot) -> tuple[Memory, float]:
        """With the robot's references of the mounting that are new, and the p-value of the least likely one.

        Rank-one updates: each is one more measurement of a remembered unknown.
        """
        known, p_value = self, 1.0
        for reference in robot.references:
            if not isinstance(reference, MountingError) or reference in self.references:
                continue
            if reference.parameter not in known.names:  # then it adds information to the tolerances
                continue
            i = known.names.index(reference.parameter)
            value, sd = measured_value(reference, robot)
            off = value - known.mean[i]
            variance = known.covariance[i, i] + sd**2
            gain = known.covariance[:, i] / variance
            known = replace(
                known,
                mean=known.mean + gain * off,
                covariance=known.covariance - np.outer(gain, known.covariance[i]),
                references=(*known.references, reference),
            )
            p_value = min(p_value, float(2.0 * ndtr(-abs(off) / np.sqrt(variance))))
        return known, p_value

    def about(self, names: Collection[str]) -> Memory:
        """Only the memory of these parameters: the others are not unknowns of the current run."""
        kept = [k for k, name in enumerate(self.names) if name in names]
        return replace(
            self,
            names=tuple(self.names[k] for k in kept),
            mean=self.mean[kept],
            covariance=self.covariance[np.ix_(kept, kept)],
        )

    def prior(self, parameters: tuple[Parameter, ...]) -> Prior:
        """Prior of all parameters: from the memory where it contains them, otherwise from their tolerance."""
        order = {p.name: i for i, p in enumerate(parameters)}
        known = [(k, order[name]) for k, name in enumerate(self.names) if name in order]
        mine, theirs = [k for k, _ in known], [i for _, i in known]
        mean = np.array([p.prior_mean for p in parameters])
        mean[theirs] = self.mean[mine]
        sd = np.array([p.prior_sd for p in parameters])
        sd[theirs] = np.inf
        rest = Prior.independent(mean, sd).root
        remembered = np.zeros((len(mine), len(parameters)))
        information = np.linalg.inv(self.covariance[np.ix_(mine, mine)])
        remembered[:, theirs] = np.linalg.cholesky(information).T
        return Prior(mean, np.vstack([rest, remembered]))


def contradiction_p(solution: Solution, prior: Prior, parameters: tuple[Parameter, ...]) -> float:
    """p-value of the readings under the memory, in the directions that they determine.

    The zero offsets and reading offsets, which the memory does not contain, are projected out; in each
    remaining direction the misfit of the memory has variance 1 (noise) plus that of the memory.
    """
    lasting = [i for i, p in enumerate(parameters) if p.lasting]
    passing = [i for i in range(len(parameters)) if i not in lasting]
    J = solution.jacobian
    nuisance = np.linalg.qr(J[:, passing] / np.linalg.norm(J[:, passing], axis=0))[0]
    root = prior.root[:, lasting]
    spread = np.linalg.inv(np.linalg.cholesky(root.T @ root)).T
    informed = J[:, lasting] @ spread
    informed -= nuisance @ (nuisance.T @ informed)
    misfit = solution.residual + J[:, lasting] @ (prior.mean - solution.x)[lasting]
    misfit -= nuisance @ (nuisance.T @ misfit)
    U, sigma, _ = np.linalg.svd(informed, full_matrices=False)
    can_tell = sigma > INFORMATIVE
    if not can_tell.any():
        return 1.0
    square = (U[:, can_tell].T @ misfit) ** 2 / (1.0 + sigma[can_tell] ** 2)
    return float(chdtrc(int(can_tell.sum()), square.sum()))
