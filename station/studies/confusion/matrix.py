"""The diagnosis against random machines, kind by kind."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from pydantic import JsonValue

from station.studies.confusion.claims import Outcome, outcome
from station.studies.confusion.kinds import GROUPS, KINDS
from station.studies.engine import Engine

CLEAN = "none"
BINS = 10


@dataclass(frozen=True)
class Row:
    """All machines of one kind."""

    kind: str
    group: str
    outcomes: tuple[Outcome, ...]

    @property
    def clear(self) -> tuple[Outcome, ...]:
        return tuple(o for o in self.outcomes if o.clear)

    @property
    def said(self) -> Counter[str]:
        return Counter(o.said for o in self.outcomes)

    @property
    def off_sd(self) -> list[float]:
        """The larger error of both zero offsets of each machine, in standard uncertainties."""
        return [max(map(abs, o.zeros.off_sd)) for o in self.outcomes if o.zeros is not None]

    @property
    def inside_95(self) -> float:
        """Share of the zero offsets that their 95 % intervals hold."""
        inside = [o.zeros.inside_95 / 2.0 for o in self.outcomes if o.zeros is not None]
        return float(np.mean(inside)) if inside else float("nan")

    @property
    def sd_deg(self) -> float:
        """Median standard uncertainty of the zero offsets."""
        sds = [o.zeros.sd_deg for o in self.outcomes if o.zeros is not None]
        return float(np.median(sds)) if sds else float("nan")

    @property
    def worse(self) -> int:
        """Machines that stand worse than before, and worse than was said."""
        return sum(o.errors is not None and o.errors.worse for o in self.outcomes)


@dataclass(frozen=True)
class Reliability:
    """Statements of about the same probability."""

    stated: float
    true: float
    count: int


def run(machines: int, seed: int, engine: Engine, kinds: Sequence[tuple[str, ...]] = KINDS) -> list[Row]:
    """`machines` of each of these kinds."""
    drawn = [(kind, seed * 1_000_003 + k) for kind in kinds for k in range(machines)]
    found = engine.each(outcome, drawn, "Claims")
    group = {kind: name for name, some in GROUPS.items() for kind in some}
    return [
        Row(label(kind), group[kind], tuple(found[k * machines : (k + 1) * machines]))
        for k, kind in enumerate(kinds)
    ]


def label(kind: tuple[str, ...]) -> str:
    """What a kind is called on the page and on the command line."""
    return "+".join(kind) or CLEAN


def reliability(rows: list[Row]) -> list[Reliability]:
    """Probabilities stated beside how often they were true, in bins of equal count."""
    said = np.array(sorted(s for row in rows for o in row.outcomes for s in o.statements), dtype=float)
    bins = [b for b in np.array_split(said, BINS) if len(b)] if len(said) else []
    return [Reliability(float(b[:, 0].mean()), float(b[:, 1].mean()), len(b)) for b in bins]


def figures(rows: list[Row]) -> list[JsonValue]:
    """Plain numbers of every kind, for a digest and for other programs."""
    return [
        {
            "kind": row.kind,
            "machines": len(row.outcomes),
            "clear": len(row.clear),
            "right": sum(o.right for o in row.clear),
            "alone": sum(o.alone for o in row.clear),
            "first": sum(o.first for o in row.clear),
            "confirmed": sum(o.confirmed for o in row.clear),
            "wrong_of_all_sizes": sum(o.wrong for o in row.outcomes),
            "beyond_3_sd": sum(off > 3.0 for off in row.off_sd),
            "inside_95": row.inside_95,
            "sd_deg": row.sd_deg,
            "worse": row.worse,
            "hinted": sum(o.hinted for o in row.clear),
            "said": dict(sorted(row.said.items())),
        }
        for row in rows
    ]
