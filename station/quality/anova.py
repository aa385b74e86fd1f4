"""Analysis of variance of balanced studies whose sources are all random: tables and intervals.

Intervals are generalised confidence intervals: each mean square over its expectation is chi-square over its
degrees of freedom (Burdick, Borror and Montgomery 2005, chapter 3).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.special import fdtrc

from station.records import Real, Record

POOLED_ABOVE = 0.25
"""p-value of an interaction above which it is pooled with its reference; high, so that a real one is
retained.
"""
CATEGORIES = 1.41
"""Distinct categories per ratio of part variation to gauge variation (AIAG)."""
DRAWS = 100_000
"""Number of draws of the pivotal quantities; quantiles are good to a fraction of a percent."""
SEED = 20_05


class AnovaRow(Record):
    """One source of variation."""

    source: str
    dof: int
    sum_of_squares: float
    mean_square: float
    f: float | None
    p_value: float | None


class Interval(Record):
    """95 % confidence interval."""

    low: float
    high: float


@dataclass
class Sources:
    """Sums of squares and degrees of freedom, by source, and the reference of each source's test."""

    squares: dict[str, float]
    dof: dict[str, int]
    against: dict[str, str]

    def p_value(self, source: str) -> float:
        """p-value of the hypothesis that the source adds nothing to its reference."""
        ratio = self._f(source)
        if ratio is None:
            return 1.0 if self.squares[source] == 0.0 else 0.0
        return float(fdtrc(self.dof[source], self.dof[self.against[source]], ratio))

    def pool(self, source: str) -> None:
        """Pool a source with its reference, and test the others against the result."""
        into = self.against.pop(source)
        self.squares[into] += self.squares.pop(source)
        self.dof[into] += self.dof.pop(source)
        self.against = {tested: into if by == source else by for tested, by in self.against.items()}

    def table(self) -> tuple[AnovaRow, ...]:
        """One row per source."""
        return tuple(
            AnovaRow(
                source=source,
                dof=self.dof[source],
                sum_of_squares=square,
                mean_square=square / self.dof[source],
                f=self._f(source) if source in self.against else None,
                p_value=self.p_value(source) if source in self.against else None,
            )
            for source, square in self.squares.items()
        )

    def _f(self, source: str) -> float | None:
        """F ratio; None if the denominator has no scatter."""
        by = self.against[source]
        below = self.squares[by] / self.dof[by]
        return self.squares[source] / self.dof[source] / below if below > 0.0 else None


def mean_squares(table: tuple[AnovaRow, ...]) -> dict[str, Real]:
    """() mean square of each source."""
    return {row.source: np.array(row.mean_square) for row in table}


def drawn_expectations(table: tuple[AnovaRow, ...]) -> dict[str, Real]:
    """(DRAWS,) draws of the expectation of each mean square, given the observed one."""
    chi_squares = _chi_squares(tuple(row.dof for row in table))
    return {
        row.source: row.mean_square * row.dof / drawn for row, drawn in zip(table, chi_squares, strict=True)
    }


@lru_cache(maxsize=4)
def _chi_squares(dofs: tuple[int, ...]) -> tuple[Real, ...]:
    """(DRAWS,) draws of each; cached for studies of the same shape."""
    rng = np.random.default_rng(SEED)
    return tuple(rng.chisquare(dof, DRAWS) for dof in dofs)


def intervals_of(drawn: Mapping[str, Real]) -> dict[str, Interval]:
    """Intervals of figures (DRAWS,)."""
    return {
        name: Interval(low=float(low), high=float(high))
        for name, of in drawn.items()
        for low, high in (np.quantile(of, (0.025, 0.975)),)
    }


def deviations(repeat: Real, operators: Real, parts: Real) -> dict[str, Real]:
    """Standard deviations from variances, and percent of the total."""
    gauge = repeat + operators
    total = gauge + parts
    variances = {"ev": repeat, "av": operators, "grr": gauge, "pv": parts}
    out = {name: np.sqrt(variance) for name, variance in {**variances, "tv": total}.items()}
    with np.errstate(invalid="ignore"):
        return out | {f"{name}_percent": 100.0 * np.sqrt(v / total) for name, v in variances.items()}


def categories(parts: float, gauge: float) -> int:
    """ndc from two standard deviations; 0 if the gauge does not scatter."""
    return int(CATEGORIES * parts / gauge) if gauge > 0.0 else 0
