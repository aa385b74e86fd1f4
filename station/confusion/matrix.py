"""The diagnosis against random machines: right, right up to alias, or wrong, kind by kind."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field

from station.confusion.machines import CATALOGUE, OUTSIDE, PAIRS, Drawn, draw
from station.diagnosis.diagnose import Diagnosis, diagnose
from station.errors import InputRefused
from station.robot import Robot

CLEAR_SDS = 3.0
"""An effect counts as clearly visible when its projected RMS is this many times the noise."""
KINDS: tuple[tuple[str, ...], ...] = ((), *((k,) for k in CATALOGUE), *PAIRS, *((k,) for k in OUTSIDE))


@dataclass(frozen=True)
class Outcome:
    """What the diagnosis made of one machine."""

    clear: bool
    said: str
    """Verdict, and the effects named."""
    right: bool
    """Every cause within its alias set, nothing else blamed, confirmed."""
    alone: bool
    """Right, and every set has one member."""
    explained: bool
    """Explained and confirmed, whatever the cause."""


@dataclass
class Row:
    """All machines of one kind."""

    kind: str
    machines: int = 0
    clear: int = 0
    right: int = 0
    """Of the clear ones; of clean machines all that were called adequate."""
    alone: int = 0
    explained: int = 0
    """Of the clear ones, explained and confirmed."""
    explained_at_all: int = 0
    said: Counter[str] = field(default_factory=Counter)


def run(machines: int, seed: int = 1, progress: Callable[[], None] = lambda: None) -> list[Row]:
    """`machines` of every kind, on all cores."""
    rows = []
    with ProcessPoolExecutor(max_workers=os.cpu_count()) as pool:
        for kinds in KINDS:
            row = Row(" + ".join(kinds) or "none")
            seeds = [seed * 1_000_003 + k for k in range(machines)]
            for outcome in pool.map(_one, [kinds] * machines, seeds, chunksize=4):
                _count(row, outcome)
                progress()
            rows.append(row)
    return rows


def _one(kinds: tuple[str, ...], seed: int) -> Outcome:
    robot = Robot.default()
    drawn = draw(robot, kinds, seed)
    try:
        found = diagnose(robot, drawn.walk, drawn.fresh)
    except InputRefused as refusal:
        return Outcome(_clear(drawn), f"refused: {str(refusal)[:40]}", False, False, False)
    return judge(drawn, found)


def judge(drawn: Drawn, found: Diagnosis) -> Outcome:
    """Compare what was found with what is in the machine."""
    sets = [{f.term.key, *(t.key for t in f.aliases)} for f in found.trace.findings]
    wanted = list(drawn.truth)
    named = ", ".join(sorted(f.term.effect.label for f in found.trace.findings))
    explained = found.verdict == "explained" and found.confirmed is True
    if not wanted:
        right = found.verdict == "adequate" and not sets
    else:
        right = (
            explained
            and all(any(cause in s for s in sets) for cause in wanted)
            and all(any(cause in s for cause in wanted) for s in sets)
        )
    return Outcome(
        clear=_clear(drawn),
        said=f"{found.verdict}: {named}" if named else found.verdict,
        right=right,
        alone=right and all(len(s) == 1 for s in sets),
        explained=explained,
    )


def _clear(drawn: Drawn) -> bool:
    return all(size > CLEAR_SDS * drawn.scatter_um for size in drawn.size_um)


def _count(row: Row, outcome: Outcome) -> None:
    row.machines += 1
    row.said[outcome.said] += 1
    row.explained_at_all += outcome.explained
    if outcome.clear:
        row.clear += 1
        row.right += outcome.right
        row.alone += outcome.alone
        row.explained += outcome.explained


def markdown(rows: list[Row]) -> Iterator[str]:
    """The table of docs/confusion.md, a line at a time."""
    yield (
        "| in the machine | machines | clearly visible | right | with no alias | explained and confirmed "
        "| said most |"
    )
    yield "|---|---|---|---|---|---|---|"
    for row in rows:
        share = f"{row.right}/{row.clear}" if row.kind not in OUTSIDE else "-"
        most = "; ".join(f"{text} ({count})" for text, count in row.said.most_common(3))
        yield (
            f"| {row.kind} | {row.machines} | {row.clear} | {share} | {row.alone} | "
            f"{row.explained} of the clear, {row.explained_at_all} of all | {most} |"
        )
