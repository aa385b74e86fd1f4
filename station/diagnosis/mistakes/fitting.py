"""Fits of the base model under a hypothesis, and how probable they make the readings.

`fit` is the exact one: all parameters with their priors, some loosened, some columns added, the noise level
estimated. `rough` is the fast one, which tolerates up to nine wrong rows in twenty: two zero offsets and the
reading offset, gross rows down-weighted.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from station.fitting import NotConvergedError, Prior, Solution, solve
from station.five_bar import SCALE_SD_MM, FiveBar, Robot
from station.records import Flags, Measurements, Real

OFFSET_SD_MM = 1e4
"""Prior of the reading offset: as wide as any measured distance."""
LEAST_NOISE = 0.2
"""Noise over the specification may be this low: servos that stop on whole pulses leave no half pulse
unknown.
"""
SOFT_MM = 0.05
"""Residual from which a row counts as disagreeing, in the rough fit."""
ANNEALED_MM = (200.0, 100.0, 50.0, 25.0, 12.0, 6.0, 3.0, 1.5, 0.8, 0.4, 0.2, 0.1, 0.05, 0.05, 0.05)
"""Widths of the Cauchy weights, one after the other."""


@dataclass(frozen=True)
class Extra:
    """One additional column: an angle or a reading that varies with it."""

    name: str
    sd: float
    """Prior, in the column's own unit."""
    by_angle: Real | None = None
    """(K, 2) rad per unit, added to the joint angles."""
    by_reading: Real | None = None
    """(K,) mm per unit, added to the predicted reading."""


@dataclass(frozen=True)
class Fitted:
    """A converged fit."""

    p: Real
    """(P,) of the base model, mm and rad."""
    sd: Real
    """(P,)"""
    extra: Mapping[str, float]
    extra_sd: Mapping[str, float]
    residual_mm: Real
    """(K,) measured less predicted, of all rows."""
    row_sd: Real
    """(K,) mm as specified."""
    used: Flags
    """(K,) rows that were used."""
    noise: float
    """Standard deviation of the readings over the specified one, at least `LEAST_NOISE`."""
    deviance: float
    """Minus twice the log of the readings' evidence, up to a constant of the rows that were used."""

    @property
    def rms_mm(self) -> float:
        return float(np.sqrt(np.mean(self.residual_mm[self.used] ** 2)))


def row_sd(robot: Robot, m: Measurements) -> Real:
    """(K,) mm as specified; where the links do not meet, the median of the others."""
    with np.errstate(invalid="ignore"):
        sd = FiveBar(robot, m).row_sd
    good = np.isfinite(sd)
    typical = float(np.median(sd[good])) if good.any() else 2.0 * SCALE_SD_MM
    return np.where(good, sd, typical)


def fit(
    robot: Robot,
    m: Measurements,
    *,
    loosened: Mapping[str, float] | None = None,
    extras: tuple[Extra, ...] = (),
    used: Flags | None = None,
    start: Real | None = None,
    prior: tuple[Real, Real] | None = None,
) -> Fitted | None:
    """None where it does not converge.

    :param loosened: parameter -> standard deviation in place of its prior's, mm or rad
    :param prior: mean (P,) and root (H, P) in place of all of that
    """
    mechanism = FiveBar(robot, m)
    mean, root = prior or _tolerances(mechanism, loosened or {})
    problem = _Problem(
        mechanism,
        extras,
        np.ones(len(m), dtype=bool) if used is None else used,
        row_sd(robot, m),
        _with_extras(mean, root, extras),
    )
    begin = problem.prior.mean.copy()
    if start is None:
        problem.set_offset(begin)
    else:
        begin[: len(start)] = start
    noise = 1.0
    for _ in range(3):
        with np.errstate(invalid="ignore"):
            found = problem.solved(begin, noise)
        if found is None:
            return None
        solution, begin = found, found.x
        square = float(np.sum((solution.residual * noise) ** 2))
        wanted = max(LEAST_NOISE, float(np.sqrt(square / max(int(problem.used.sum()) - 4, 1))))
        done = abs(np.log(wanted / noise)) < 0.05
        noise = wanted
        if done:
            break
    return problem.fitted(solution, noise, square)


def _tolerances(mechanism: FiveBar, loosened: Mapping[str, float]) -> tuple[Real, Real]:
    """Mean (P,) and root (P, P) of the parameters' own priors, some of them loosened."""
    spread = np.array([loosened.get(p.name, min(p.prior_sd, OFFSET_SD_MM)) for p in mechanism.parameters])
    return mechanism.start, np.diag(1.0 / spread)


def _with_extras(mean: Real, root: Real, extras: tuple[Extra, ...]) -> Prior:
    count = len(extras)
    widths = np.array([e.sd for e in extras])
    whole = np.block(
        [[root, np.zeros((len(root), count))], [np.zeros((count, len(mean))), np.diag(1.0 / widths)]]
    )
    return Prior(np.concatenate([mean, np.zeros(count)]), whole)


@dataclass(frozen=True)
class _Problem:
    """Unknowns z (P + Q,): parameters of the base model, then one for each extra column."""

    mechanism: FiveBar
    extras: tuple[Extra, ...]
    used: Flags
    """(K,)"""
    row_sd: Real
    """(K,) mm"""
    prior: Prior

    @cached_property
    def by_angle(self) -> Real:
        """(K, 2, Q)"""
        return np.stack([_or_zero(e.by_angle, (len(self.used), 2)) for e in self.extras], axis=2)

    @cached_property
    def by_reading(self) -> Real:
        """(K, Q)"""
        return np.stack([_or_zero(e.by_reading, (len(self.used),)) for e in self.extras], axis=1)

    def predict(self, z: Real) -> tuple[Real, Real]:
        """(K,) prediction, mm, and its derivatives with respect to the unknowns (K, P + Q)."""
        theta = self.mechanism.measurements.theta
        if not self.extras:
            at = self.mechanism.observe(z, theta)
            return at.value, at.by_parameter
        p, q = z[: -len(self.extras)], z[-len(self.extras) :]
        at = self.mechanism.observe(p, theta + self.by_angle @ q)
        by_extra = np.einsum("kj,kjq->kq", at.by_joint, self.by_angle) + self.by_reading
        return at.value + self.by_reading @ q, np.hstack([at.by_parameter, by_extra])

    def set_offset(self, z: Real) -> None:
        """Set the reading offsets of `z` in place to the typical deviation of most readings."""
        m = self.mechanism.measurements
        with np.errstate(invalid="ignore"):
            offset = np.nanmedian(self.predict(z)[0] - m.distance) if self.used.any() else 0.0
        size = len(z) - len(self.extras)
        z[size - len(m.mounts) : size] += offset if np.isfinite(offset) else 0.0

    def solved(self, begin: Real, noise: float) -> Solution | None:
        """The fit with readings that scatter by `noise` times specified; None without convergence."""
        distance, used, sd = self.mechanism.measurements.distance, self.used, self.row_sd[self.used]

        def residuals(z: Real) -> tuple[Real, Real]:
            value, J = self.predict(z)
            return (value - distance)[used] / sd / noise, J[used] / (sd * noise)[:, None]

        try:
            found = solve(residuals, begin, self.prior)
        except (NotConvergedError, np.linalg.LinAlgError):
            return None
        return found if found.complete else None

    def fitted(self, solution: Solution, noise: float, square: float) -> Fitted:
        """:param square: sum of squares of the residuals over their specified standard deviation"""
        J, held = solution.jacobian, self.prior
        normal = held.root.T @ held.root
        pulled = float(np.sum((held.root @ (solution.x - held.mean)) ** 2))
        occam = float(np.linalg.slogdet(J.T @ J + normal)[1] - np.linalg.slogdet(normal)[1])
        deviance = int(self.used.sum()) * 2.0 * np.log(noise) + square / noise**2 + pulled + occam
        deviance += 2.0 * float(np.sum(np.log(self.row_sd[self.used])))
        spread = np.sqrt(np.diag(np.linalg.pinv(J.T @ J + normal)))
        size, names = len(solution.x) - len(self.extras), [e.name for e in self.extras]
        with np.errstate(invalid="ignore"):
            predicted = self.predict(solution.x)[0]
        return Fitted(
            solution.x[:size],
            spread[:size],
            dict(zip(names, solution.x[size:].tolist(), strict=True)),
            dict(zip(names, spread[size:].tolist(), strict=True)),
            self.mechanism.measurements.distance - predicted,
            self.row_sd,
            self.used,
            noise,
            float(deviance),
        )


def posterior(robot: Robot, m: Measurements, found: Fitted) -> tuple[Real, Real]:
    """Mean (P,) and root (P, P) of a base-model fit's posterior, as prior for `fit` of other readings."""
    mechanism = FiveBar(robot, m)
    at = mechanism.observe(found.p, m.theta)
    J = (at.by_parameter / (found.row_sd * found.noise)[:, None])[found.used]
    stacked = np.vstack([J, _tolerances(mechanism, {})[1]])
    return found.p, np.asarray(np.linalg.qr(stacked, mode="r"))


def _or_zero(column: Real | None, shape: tuple[int, ...]) -> Real:
    return np.zeros(shape) if column is None else column


@dataclass(frozen=True)
class Rough:
    """Zero offsets and reading offset on which most rows agree."""

    p: Real
    """(P,) parameters of the base model."""
    residual_mm: Real
    """(K,) NaN where the links do not meet."""

    @property
    def cost(self) -> float:
        """Mean over the rows of log(1 + (residual / 0.05 mm)^2)."""
        return mean_cost(self.residual_mm)


def mean_cost(residual_mm: Real) -> float:
    """Mean of `costs`."""
    return float(np.mean(costs(residual_mm)))


def costs(residual_mm: Real) -> Real:
    """(K,) log(1 + (residual / 0.05 mm)^2); a row without a residual counts as off by a metre."""
    return np.log1p((np.where(np.isfinite(residual_mm), residual_mm, 1e3) / SOFT_MM) ** 2)


def rough(
    robot: Robot,
    m: Measurements,
    weights: Flags | None = None,
    from_mm: float = ANNEALED_MM[0],
    start: Real | None = None,
) -> Rough:
    """Robust fit of zero offsets, the mechanism within its tolerance and reading offset.

    :param weights: (K,) weights of the rows; the residual is computed for all
    """
    mechanism = FiveBar(robot, m)
    names = [p.name for p in mechanism.parameters]
    p = mechanism.start if start is None else start.copy()
    free = [0, 1, names.index("rMy"), *range(len(names) - len(m.mounts), len(names))]
    mean = mechanism.start[free]
    zero_sd = np.radians(robot.tolerances.zero_offset_deg)
    tight = np.array([zero_sd, zero_sd, robot.drm_sd[1], *[OFFSET_SD_MM] * len(m.mounts)])
    decide = np.ones(len(m), dtype=bool) if weights is None else weights
    with np.errstate(invalid="ignore"):
        at = mechanism.observe(p, m.theta)
        for mount in range(len(m.mounts)):
            own = decide & (m.mount == mount) & np.isfinite(at.value)
            if own.any():
                p[len(names) - len(m.mounts) + mount] += np.median((at.value - m.distance)[own])
        for width in ANNEALED_MM:
            if width > from_mm:
                continue
            at = mechanism.observe(p, m.theta)
            r = m.distance - at.value
            ok = decide & np.isfinite(r)
            if ok.sum() < len(free):
                break
            w = 1.0 / (1.0 + (r[ok] / width) ** 2) / width**2
            J = at.by_parameter[ok][:, free]
            # the prior counts as in a fit whose rows scatter by the present width
            hold = np.diag(1.0 / tight**2)
            step = np.linalg.lstsq(
                J.T @ (J * w[:, None]) + hold, J.T @ (w * r[ok]) - hold @ (p[free] - mean), rcond=None
            )[0]
            step[:2] = np.clip(step[:2], -0.1, 0.1)
            p[free] += step
        residual = m.distance - mechanism.observe(p, m.theta).value
    return Rough(p, residual)
