"""Evidence of linear-Gaussian errors in closed form, for all members and sizes of all families at once.

With whitened columns B (K, q) of an error and amplitudes ~ N(0, size^2), the evidence over that of the base
model is |1 + size^2 B'B|^-1/2 exp(gain), gain = b' (size^-2 + B'B)^-1 b / 2, b = B'e.  The part taken up by
errors that are known already is projected out by an update of rank r. The noise level is averaged
(`noise_level`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from scipy.special import log_ndtr

from station.diagnosis.explanations.family import Family
from station.diagnosis.explanations.frame import Frame
from station.diagnosis.explanations.gains import gain_and_log_det
from station.diagnosis.explanations.noise_level import NoiseLevel
from station.records import Index, Real

HOPELESS = 1e6
WIDTHS = (1, 2, 4, 8, 16, 32)
"""Families are grouped by their number of amplitudes, padded with empty columns to these widths."""
SHARES = (0.5, 0.25, 0.12, 0.06, 0.03, 0.015, 0.008, 0.004, 0.002)
"""Shares of the search step by which continuous hidden parameters are refined,"""
COARSE, FLAT = 0.03, 0.1
"""from the first of these shares on only where a move changes the log of evidence by more than the second."""
LOG2 = float(np.log(2.0))


class Choice(NamedTuple):
    """One member of a family at one size."""

    family: int
    member: int
    node: int


@dataclass(frozen=True)
class Known:
    """The part that errors at fixed members and sizes take up."""

    directions: Real
    """(K, r) orthonormal."""
    share: Real
    """(r,) of each direction."""
    along: Real
    """(r,) projection of the observation on each direction."""
    gain: float
    log_det: float
    sign: float
    """log of the factor by which bounds on signs change the evidence."""


class Scan(NamedTuple):
    """Evidence of each family, given the known errors: averaged over members and sizes, and the best."""

    total: Real
    """(F,) log evidence over the base model's; -inf where not computed."""
    best: tuple[Choice | None, ...]
    at_best: Real
    """(F,) log evidence of the best choice."""


@dataclass(frozen=True)
class _Group:
    families: tuple[int, ...]
    first: Index
    """(families + 1) index of each family's first member."""
    X: Real
    """(V, q, K) whitened columns."""
    gram: Real
    along: Real
    precision: Real
    """(V, T) size^-2"""
    signed: Real
    """(V,)"""


class Bank:
    """All families whitened in one frame."""

    def __init__(self, frame: Frame, families: Sequence[Family], noise: NoiseLevel) -> None:
        self.frame, self.noise = frame, noise
        self.families = list(families)
        self.square = float(frame.white @ frame.white)
        self.base = float(noise(np.array(self.square)))
        self._groups = self._grouped()
        self._where = {
            family: (g, k) for g, group in enumerate(self._groups) for k, family in enumerate(group.families)
        }

    def _grouped(self) -> list[_Group]:
        by_width: dict[int, list[tuple[int, Real]]] = {}
        for index, family in enumerate(self.families):
            columns = self.frame.signature(family)
            self.families[index] = replace(family, width=columns.shape[2])
            width = next(w for w in WIDTHS if w >= columns.shape[2])
            by_width.setdefault(width, []).append((index, columns))
        out = []
        for width, members in sorted(by_width.items()):
            count = sum(len(columns) for _, columns in members)
            X: Real = np.zeros((count, width, len(self.frame.row_sd)))
            first = np.cumsum([0, *(len(columns) for _, columns in members)])
            for (_, columns), at in zip(members, first, strict=False):
                X[at : at + len(columns), : columns.shape[2]] = columns.transpose(0, 2, 1)
            X = self.frame.whiten(X)
            sizes = np.vstack(
                [np.tile(self.families[index].sizes, (len(columns), 1)) for index, columns in members]
            )
            signed = np.concatenate(
                [np.full(len(columns), self.families[index].signed) for index, columns in members]
            )
            out.append(
                _Group(
                    tuple(index for index, _ in members), first, X, X @ X.transpose(0, 2, 1),
                    X @ self.frame.white, sizes**-2.0, signed,
                )
            )  # fmt: skip
        return out

    def columns(self, choice: Choice) -> Real:
        """(K, q) whitened columns of one member."""
        g, k = self._where[choice.family]
        group = self._groups[g]
        member = group.X[group.first[k] + choice.member]
        return np.asarray(member[np.any(member != 0.0, axis=1)].T)

    def members(self, family: int) -> Real:
        """(V, q, K) whitened columns of a family."""
        g, k = self._where[family]
        group = self._groups[g]
        return np.asarray(group.X[group.first[k] : group.first[k + 1], : self.families[family].width])

    def known(self, choices: Sequence[Choice]) -> Known:
        """The part that these errors take up together."""
        K = len(self.frame.row_sd)
        if not choices:
            return Known(np.zeros((K, 0)), np.zeros(0), np.zeros(0), 0.0, 0.0, 0.0)
        B = np.hstack([self.columns(c) * self.families[c.family].sizes[c.node] for c in choices])
        U, D, _ = np.linalg.svd(B, full_matrices=False)
        share = D**2 / (1.0 + D**2)
        along = U.T @ self.frame.white
        gain = 0.5 * float(share @ along**2)
        return Known(U, share, along, gain, float(np.sum(np.log1p(D**2))), self._sign(choices, B))

    def _sign(self, choices: Sequence[Choice], B: Real) -> float:
        """For each signed amplitude, twice the posterior probability that it is not negative."""
        if not any(self.families[c.family].signed for c in choices):
            return 0.0
        covariance = np.linalg.inv(np.eye(B.shape[1]) + B.T @ B)
        mean = covariance @ (B.T @ self.frame.white)
        out, at = 0.0, 0
        for c in choices:
            if self.families[c.family].signed:
                out += float(log_ndtr(mean[at] / np.sqrt(covariance[at, at]))) + LOG2
            at += self.columns(c).shape[1]
        return out

    def log_evidence(self, k: Known) -> float:
        """Log evidence of errors at fixed members and sizes, over the base model's."""
        q = np.array(self.square - 2.0 * k.gain)
        return -0.5 * k.log_det + float(self.noise(q)) - self.base + k.sign

    def scan(self, known: Known, only: int | None = None) -> Scan:
        """Every family (or `only` one) beside known errors."""
        count = len(self.families)
        total, at_best = np.full(count, -np.inf), np.full(count, -np.inf)
        best: list[Choice | None] = [None] * count
        for g, group in enumerate(self._groups):
            if only is not None and self._where[only][0] != g:
                continue
            wanted = range(len(group.families)) if only is None else (self._where[only][1],)
            low, high = int(group.first[wanted[0]]), int(group.first[wanted[-1] + 1])
            value = self._of_group(group, slice(low, high), known)
            edges = group.first[wanted[0] : wanted[-1] + 2] - low
            peak = np.maximum.reduceat(value.max(axis=1), edges[:-1])
            counts = np.diff(edges)
            peak = np.where(np.isfinite(peak), peak, -HOPELESS)
            relative = np.exp(value - np.repeat(peak, counts)[:, None]).sum(axis=1)
            mean = np.add.reduceat(relative, edges[:-1]) / (counts * value.shape[1])
            for k, family in enumerate(group.families[wanted[0] : wanted[-1] + 1]):
                own = value[edges[k] : edges[k + 1]]
                total[family], at_best[family] = peak[k] + np.log(mean[k] + 1e-300), peak[k]
                best[family] = Choice(family, *divmod(int(own.argmax()), own.shape[1]))
        return Scan(total, tuple(best), at_best)

    def singles(self, family: int) -> list[Choice]:
        """Every member of a family at its best size when it is the only error."""
        g, k = self._where[family]
        group = self._groups[g]
        value = self._of_group(group, slice(int(group.first[k]), int(group.first[k + 1])), self.known(()))
        return [Choice(family, member, int(node)) for member, node in enumerate(value.argmax(axis=1))]

    def refine(self, choice: Choice, known: Known) -> None:
        """Move a member to the best values of its continuous hidden parameters beside known errors."""
        family = self.families[choice.family]
        if family.neighbours is None:
            return
        g, k = self._where[choice.family]
        group = self._groups[g]
        row = int(group.first[k]) + choice.member
        hidden, here = family.hidden[choice.member], group.X[row : row + 1]
        precision, signed = group.precision[row : row + 1], group.signed[row : row + 1]
        value = float(self._values(here, precision, signed, known).max())
        for share in SHARES:
            near = replace(family, hidden=tuple(family.neighbours(hidden, share)))
            columns = self.frame.signature(near)
            X = np.zeros((len(columns), *group.X.shape[1:]))
            X[:, : columns.shape[2]] = columns.transpose(0, 2, 1)
            X = self.frame.whiten(X)
            count = len(X)
            values = self._values(X, np.repeat(precision, count, 0), np.repeat(signed, count), known).max(
                axis=1
            )
            change = float(values.max()) - value
            if change > 0.0:
                at = int(values.argmax())
                value, hidden, here = float(values[at]), near.hidden[at], X[at : at + 1]
            if share <= COARSE and abs(change) < FLAT:
                break
        group.X[row : row + 1] = here
        group.gram[row], group.along[row] = here[0] @ here[0].T, here[0] @ self.frame.white
        moved = (*family.hidden[: choice.member], hidden, *family.hidden[choice.member + 1 :])
        self.families[choice.family] = replace(family, hidden=moved)

    def _of_group(self, group: _Group, rows: slice, known: Known) -> Real:
        """(V, T) log evidence of members of a group, over the base model's."""
        ready = group.gram[rows], group.along[rows]
        return self._values(group.X[rows], group.precision[rows], group.signed[rows], known, ready)

    def _values(
        self, X: Real, precision: Real, signed: Real, known: Known, ready: tuple[Real, Real] | None = None
    ) -> Real:
        """(V, T) log evidence of whitened columns X (V, q, K), over the base model's."""
        gram, along = ready if ready is not None else (X @ X.transpose(0, 2, 1), X @ self.frame.white)
        shows = gram[:, 0, 0] > 0.0
        if len(known.share):
            Y = (X.reshape(-1, X.shape[2]) @ known.directions).reshape(*X.shape[:2], -1)
            gram = gram - (Y * known.share) @ Y.transpose(0, 2, 1)
            along = along - Y @ (known.share * known.along)
        gain, log_det = gain_and_log_det(gram, along, precision)
        out = (
            self.noise(self.square - 2.0 * (known.gain + gain)) - self.base - 0.5 * (known.log_det + log_det)
        )
        signed = signed & (X.shape[1] == 1)
        if signed.any():
            b, S = along[signed, 0][:, None], gram[signed, 0, 0][:, None]
            out[signed] += log_ndtr(b / np.sqrt(S + precision[signed])) + LOG2
        out[~shows] = -np.inf
        return np.asarray(out + known.sign)
