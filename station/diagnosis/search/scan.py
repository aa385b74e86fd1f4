"""The catalogue against one residual: every effect projected, tested, priced.

The part of each signature that the base parameters could take up is projected out first
(Frisch-Waugh-Lovell); tolerance priors are included as additional readings.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import minimize_scalar
from scipy.special import fdtrc

from station.diagnosis.search.evidence import learned_spread
from station.effects import Acts, Effect, Variants, signature, weight
from station.fitting import solved
from station.mechanism import Conditions
from station.model import Fit, Term
from station.records import Index, Real

INVISIBLE_SHARE = 0.01
"""A signature of which a smaller share than this remains (RMS) is not detectable in these readings."""


@dataclass(frozen=True)
class Candidate:
    """The best variant of one effect against one residual."""

    effect: Effect
    hidden: Mapping[str, float]
    variants: Variants
    reduction: float
    """Reduction of the cost."""
    size: int
    """Number of amplitudes."""
    freedom: float
    """Number of them that the readings determine; `size` where there is no prior."""
    p_value: float
    """p-value of the F test, with the price of the search included."""
    visible_share: float

    @property
    def visible(self) -> bool:
        return self.visible_share >= INVISIBLE_SHARE

    def term(self) -> Term:
        return Term(self.effect, self.hidden, self.variants.acts, self.size, self.variants.spread)


@dataclass(frozen=True)
class _ByReading:
    """Sums over the rows of each reading, times their whitened weight; a signature is weight by basis."""

    jacobian: Real
    """(K, P)"""
    residual: Real
    """(K,)"""
    square: Real
    """(K,) of the weight itself"""
    weight: Real
    """(K,)"""


class Scan:
    """One fit's residual, ready to be compared with signatures."""

    def __init__(self, fit: Fit) -> None:
        self.fit = fit
        held = np.isfinite(np.diag(fit.solution.covariance))
        self._J = fit.solution.jacobian[:, held]
        self._taken_up = fit.solution.covariance[np.ix_(held, held)]
        self._residual = -fit.solution.residual
        self._own_cost = float(self._residual @ self._residual)
        self._own_dof = len(self._residual) - fit.freedom
        self._by_reading: tuple[Acts, _ByReading] | None = None

    def candidates(self, effects: Sequence[Effect]) -> list[Candidate]:
        """The best variant of every effect that these readings can show, most significant first."""
        found = []
        # joint by joint, as the sums over rows are made for one place of action at a time
        for effect in sorted(effects, key=lambda e: e.joint or 0):
            variants = effect.variants(self.fit.conditions)
            if variants is not None:
                found.append(self._best(effect, variants))
        return sorted(found, key=lambda c: (c.p_value, -c.reduction))

    def reductions(self, variants: Variants, basis: Real) -> tuple[Real, Real, Real]:
        """For basis (V, K, q): cost reduction (V,), visible share (V,), information (V,)."""
        left, along, share = self._projected(variants, basis)
        reduction, largest = explained(left, along)
        return self._possible(reduction), share, largest

    def _possible(self, reduction: Real) -> Real:
        """(V,) the same, 0 where it exceeds the possible value: rounding along an invisible direction."""
        return np.where(reduction <= self.fit.cost, reduction, 0.0)

    def signature(self, candidate: Candidate) -> Real:
        """(R, q) signature of a candidate as found, mm per unit of amplitude."""
        model = self.fit.model
        basis = candidate.effect.at(candidate.hidden, self.fit.conditions)
        rows = model.mechanism.reading_of_row
        return signature(candidate.variants.acts, basis, self.fit.at, model.names, rows)

    def information(self, variants: Variants) -> Real:
        """(V, q, q) information of the rows on each variant's amplitudes, with the whole model refitted."""
        return self._projected(variants, variants.basis)[0]

    def _projected(self, variants: Variants, basis: Real) -> tuple[Real, Real, Real]:
        """Remainder of signatures: information (V, q, q), gradient (V, q), and their share (V,) in RMS."""
        shape, rows = basis.shape[::2], len(self.fit.row_sd)
        flat = basis.transpose(1, 0, 2).reshape(basis.shape[1], -1)
        of = self._summed(variants.acts)
        # the part of each that the parameters in the model would take up: S' J (J'J + W'W)^-1 J' S
        inside = of.jacobian.T @ flat
        back = self._taken_up @ inside
        inside, back = (a.reshape(-1, *shape).transpose(1, 0, 2) for a in (inside, back))
        whole = basis.transpose(0, 2, 1) @ (of.square[:, None] * basis)
        left = whole - inside.transpose(0, 2, 1) @ back
        along = (of.residual @ flat).reshape(shape)
        # the part that a constant reading offset takes up does not belong to a signature
        mean = (of.weight @ flat).reshape(shape) / rows
        total = np.trace(whole, axis1=1, axis2=2) - rows * np.sum(mean**2, axis=1)
        share = np.sqrt(np.maximum(np.trace(left, axis1=1, axis2=2), 0.0) / np.where(total > 0, total, 1.0))
        return left, along, share

    def _summed(self, acts: Acts) -> _ByReading:
        """Sums of signatures with one place of action; those of the last such place are cached."""
        if self._by_reading is None or self._by_reading[0] != acts:
            model = self.fit.model
            w = weight(acts, self.fit.at, model.names) / self.fit.row_sd
            rows = model.mechanism.reading_of_row
            self._by_reading = (
                acts,
                _ByReading(
                    _over_rows(self._J * w[:, None], rows),
                    _over_rows(self._residual * w, rows),
                    _over_rows(w**2, rows),
                    _over_rows(w, rows),
                ),
            )
        return self._by_reading[1]

    def step(self, columns: Real) -> Real:
        """(q,) amplitudes with which added whitened columns (R, q) fit the residual, all else refitted."""
        left = columns - self._J @ (self._taken_up @ (self._J.T @ columns))
        return np.asarray(np.linalg.lstsq(left, self._residual, rcond=None)[0])

    def _best(self, effect: Effect, variants: Variants) -> Candidate:
        left, along, share = self._projected(variants, variants.basis)
        if variants.spread is not None:
            return self._with_spread(effect, variants, left[0], along[0], float(share[0]))
        reduction = np.where(share >= INVISIBLE_SHARE, self._possible(explained(left, along)[0]), 0.0)
        best = int(np.argmax(reduction))
        size = variants.basis.shape[2]
        return Candidate(
            effect=effect,
            hidden=variants.hidden[best],
            variants=variants,
            reduction=float(reduction[best]),
            size=size,
            freedom=float(size),
            p_value=self._p_value(float(reduction[best]), size, variants.trials),
            visible_share=float(share[best]),
        )

    def _with_spread(
        self, effect: Effect, variants: Variants, left: Real, along: Real, share: float
    ) -> Candidate:
        """Count only as many of the amplitudes with a prior as the readings determine."""
        assert variants.spread is not None
        size = len(along)
        noise = max(self.fit.cost / max(self.fit.dof, 1), 1.0)
        spread, _ = learned_spread(left / noise, along / noise, variants.spread, effect.bands(size))
        held = solved(left + np.diag(noise / spread**2), np.column_stack([left, along]))
        freedom = max(float(np.trace(held[:, :size])), 1.0)
        reduction = float(self._possible(np.asarray(along @ held[:, size])))
        return Candidate(
            effect=effect,
            hidden=variants.hidden[0],
            variants=replace(variants, spread=spread),
            reduction=reduction,
            size=size,
            freedom=freedom,
            p_value=self._p_value(reduction, freedom, variants.trials),
            visible_share=share,
        )

    def _p_value(self, reduction: float, freedom: float, trials: float) -> float:
        dof, own = self.fit.dof - freedom, self._own_dof - freedom
        if min(dof, own) <= 0:
            return 1.0
        # wide tolerances add nothing to the readings' scatter, but degrees of freedom
        noise = max((self.fit.cost - reduction) / dof, (self._own_cost - reduction) / own, 1e-12)
        return float(min(1.0, trials * fdtrc(freedom, dof, reduction / freedom / noise)))

    def refine(self, candidate: Candidate) -> Candidate:
        """Settle searched hidden parameters between the grid's points, with their sd."""
        c: Conditions = self.fit.conditions
        ranges = candidate.effect.refined(candidate.hidden, c)
        hidden = dict(candidate.hidden)
        reduction = candidate.reduction
        for name, (low, high) in ranges.items():

            def lost(value: float, name: str = name) -> float:
                basis = candidate.effect.at({**hidden, name: value}, c)
                return -float(self.reductions(candidate.variants, basis[None])[0][0])

            found = minimize_scalar(
                lost, bounds=(low, high), method="bounded", options={"xatol": 1e-6 * high}
            )
            if -found.fun < reduction:
                continue
            hidden[name], reduction = float(found.x), -float(found.fun)
            step = 0.02 * (high - low)
            curvature = (lost(found.x + step) - 2.0 * found.fun + lost(found.x - step)) / step**2
            noise = max(self.fit.cost - reduction, 1e-12) / self.fit.dof
            hidden[f"{name}_sd"] = (
                float(np.sqrt(2.0 * noise / curvature)) if curvature > 0 else float(high - low)
            )
        return replace(
            candidate,
            hidden=hidden,
            reduction=reduction,
            p_value=self._p_value(reduction, candidate.freedom, candidate.variants.trials),
        )


def _over_rows(of_row: Real, rows: Index) -> Real:
    """(K, ...) sums of (R, ...) over the rows of each reading; `rows` (R,) ascends."""
    if len(rows) == rows[-1] + 1:
        return of_row
    first = np.flatnonzero(np.diff(rows, prepend=-1))
    return np.asarray(np.add.reduceat(of_row, first))


def explained(left: Real, along: Real) -> tuple[Real, Real]:
    """along' left^-1 along for stacks of q x q matrices, q 1 or 2, and the largest diagonal of left."""
    largest = np.maximum(np.diagonal(left, axis1=1, axis2=2).max(axis=1), 0.0)
    if left.shape[1] == 1:
        g = left[:, 0, 0]
        return np.where(g > 1e-12, along[:, 0] ** 2 / np.where(g > 1e-12, g, 1.0), 0.0), largest
    a, b, d = left[:, 0, 0], left[:, 0, 1], left[:, 1, 1]
    determinant = a * d - b * b
    sound = determinant > 1e-9 * a * d
    u, v = along[:, 0], along[:, 1]
    both = (d * u * u - 2.0 * b * u * v + a * v * v) / np.where(sound, determinant, 1.0)
    return np.where(sound, both, 0.0), largest
