"""Fresh readings as an independent test: they must be new, spread over the workspace, and predicted.

The prediction is that of the explanations weighed on the earlier readings alone (docs/decisions/0013).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.special import fdtrc

from station.diagnosis.explanations.frame import added
from station.diagnosis.explanations.settle import Settled
from station.diagnosis.explanations.situation import at_readings, predicted
from station.errors import InputRefused
from station.fitting import REFUSED_P
from station.five_bar import FiveBar
from station.mechanism import Reference
from station.records import Measurements, Real

SAME_SHARE = 0.1
"""Share of fresh readings equal to earlier ones above which they are not fresh."""
COVERAGE = 0.6
"""Share of the workspace's width and of its height that fresh readings must span."""
FAR_OFF, FEW_OFF = 6.0, 0.05
"""A few readings this many standard deviations off are glitches and are excluded."""
SCATTER_DOF = 30
"""Degrees of freedom that are assumed for the noise level."""


@dataclass(frozen=True)
class Validation:
    """The result of the comparison with fresh readings."""

    new: bool
    """Whether they are not copies of the earlier readings."""
    coverage: tuple[float, float]
    """Share of the workspace's width and height that they span."""
    p_value: float
    """p-value of the prediction, averaged over the explanations."""
    rms_mm: float
    max_mm: float
    """Measured less predicted by the mean over the explanations."""
    left_out: tuple[int | str, ...]
    by_explanation: tuple[float, ...]
    """p-value of each explanation that predicted."""

    @property
    def independent(self) -> bool:
        return self.new and min(self.coverage) >= COVERAGE

    @property
    def agrees(self) -> bool:
        return self.p_value >= REFUSED_P


def validate(
    mechanism: FiveBar,
    reference: Reference,
    explanations: Sequence[tuple[Settled, float]],
    fresh: Measurements,
    row_sd: Real,
) -> Validation:
    """Predict `fresh` with explanations weighed on the readings of `mechanism`.

    row_sd (F,) is the specified noise of the fresh readings, mm.
    """
    later = mechanism.of(fresh)
    residuals, sds, p_values, kept_all = [], [], [], np.ones(len(fresh), dtype=bool)
    for settled, _ in explanations:
        residual, covariance = prediction(later, reference, settled, row_sd)
        sd = np.sqrt(np.diag(covariance))
        kept = np.abs(residual) < FAR_OFF * sd
        if np.sum(~kept) > max(1, int(FEW_OFF * len(fresh))):
            kept[:] = True
        few = residual[kept]
        square = float(few @ np.linalg.solve(covariance[np.ix_(kept, kept)], few))
        p_values.append(float(fdtrc(len(few), SCATTER_DOF, square / len(few))))
        residuals.append(residual)
        sds.append(sd)
        kept_all &= kept
    weight = np.array([w for _, w in explanations])
    weight = weight / weight.sum()
    mean = weight @ np.array(residuals)
    ids = np.array(fresh.ids, dtype=object)
    return Validation(
        new=_new(mechanism.measurements, fresh),
        coverage=_coverage(later),
        p_value=float(weight @ np.array(p_values)),
        rms_mm=float(np.sqrt(np.mean(mean[kept_all] ** 2))),
        max_mm=float(np.abs(mean[kept_all]).max()),
        left_out=tuple(ids[~kept_all]),
        by_explanation=tuple(p_values),
    )


def prediction(later: FiveBar, reference: Reference, settled: Settled, row_sd: Real) -> tuple[Real, Real]:
    """(F,) measured less predicted and its covariance (F, F), mm."""
    residual, J = tangent(later, reference, settled)
    noise = (row_sd * settled.level) ** 2
    return residual, J @ settled.covariance @ J.T + np.diag(noise)


def tangent(later: FiveBar, reference: Reference, settled: Settled) -> tuple[Real, Real]:
    """(F,) measured less predicted, and the derivatives (F, X) of the prediction by all unknowns, mm."""
    p = settled.x[: settled.size]
    plain = at_readings(later, p, reference, first=False)
    more = added(plain, settled.present)
    s = plain if more is None else at_readings(later, p, reference, more, first=False)
    columns = [f.columns(s, c.member)[0] for f, c in zip(settled.families, settled.choices, strict=True)]
    return later.measured - predicted(later, p, more), np.hstack([s.by_parameter[:, 0, :], *columns])


def _new(earlier: Measurements, fresh: Measurements) -> bool:
    """Whether fresh readings differ from the earlier ones in angles or distance."""
    before = {tuple(row) for row in np.column_stack([np.round(earlier.theta, 9), earlier.distance])}
    again = sum(tuple(row) in before for row in np.column_stack([np.round(fresh.theta, 9), fresh.distance]))
    return again <= SAME_SHARE * len(fresh)


def _coverage(later: FiveBar) -> tuple[float, float]:
    x, y = later.places(later.start).T
    (x0, x1), (y0, y1) = later.robot.workspace_x, later.robot.workspace_y
    return float(np.ptp(x) / (x1 - x0)), float(np.ptp(y) / (y1 - y0))


def together(first: Measurements, fresh: Measurements) -> Measurements:
    """All readings as one sequence; fresh positions are positions of their own.

    :raises InputRefused: fresh readings belong to a mount that was never learned.
    """
    unknown = [name for name in fresh.mounts if name not in first.mounts]
    if unknown:
        raise InputRefused(
            f"The fresh readings are of mount {unknown[0]!r}, which the earlier ones do not have."
        )
    mount = np.array([first.mounts.index(name) for name in fresh.mounts])[fresh.mount]
    came_from = np.array(fresh.came_from)
    came_from[np.isnan(came_from).any(axis=1)] = [*first.theta[-1], first.distance[-1]]

    # a clock that was set back continues from the last reading
    back = (
        max(0.0, float(first.t_s.max() - fresh.t_s.min()) + 1.0)
        if fresh.t_s.min() <= first.t_s.max()
        else 0.0
    )

    def both(a: Real | None, b: Real | None) -> Real | None:
        return None if a is None or b is None else np.concatenate([a, b])

    return replace(
        first,
        ids=(*first.ids, *fresh.ids),
        t_s=np.concatenate([first.t_s, fresh.t_s + back]),
        theta=np.concatenate([first.theta, fresh.theta]),
        approach=np.concatenate([first.approach, fresh.approach]),
        distance=np.concatenate([first.distance, fresh.distance]),
        position=np.concatenate([first.position, fresh.position + first.position.max() + 1]),
        mount=np.concatenate([first.mount, mount]),
        samples=np.concatenate([first.samples, fresh.samples]),
        temperature_c=both(first.temperature_c, fresh.temperature_c),
        payload_kg=both(first.payload_kg, fresh.payload_kg),
        tracker=both(first.tracker, fresh.tracker),
        came_from=np.concatenate([np.asarray(first.came_from), came_from]),
    )
