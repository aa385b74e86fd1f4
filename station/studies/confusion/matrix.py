"""The diagnosis against random machines: right, right up to alias, or wrong, kind by kind."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field, replace

import numpy as np
from pydantic import JsonValue

from station.diagnosis import WeighedFindings, weighed
from station.errors import InputRefused
from station.five_bar import Robot
from station.records import Real
from station.studies.confusion.errors import BeforeAndAfter, before_and_after
from station.studies.confusion.machines import CATALOGUE, OUTSIDE, PAIRS, SCATTER_UM, Drawn, draw
from station.studies.engine import Engine

CLEAR_SDS = 3.0
"""An effect counts as clearly visible when its projected RMS is this many times the noise."""
CLEAN = "none"
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
    hinted: bool
    """The strongest hint points to what is outside the catalogue."""
    errors: BeforeAndAfter | None = None
    """None where nothing was diagnosed."""


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
    hinted: int = 0
    """Of the clear ones, the strongest hint points the right way."""
    said: Counter[str] = field(default_factory=Counter)
    errors: list[BeforeAndAfter] = field(default_factory=list)
    """Of the clear ones; of causes in the catalogue those that are explained and confirmed."""


def run(machines: int, seed: int, engine: Engine) -> list[Row]:
    """`machines` of every kind."""
    drawn = [(kind, seed * 1_000_003 + k) for kind in KINDS for k in range(machines)]
    rows = {kind: Row(" + ".join(kind) or CLEAN) for kind in KINDS}
    for (kind, _), outcome in zip(drawn, engine.each(_one, drawn, "Confusion"), strict=True):
        _count(rows[kind], outcome)
    return list(rows.values())


def figures(rows: list[Row]) -> list[dict[str, JsonValue]]:
    """Plain numbers of every kind, for a digest and for other programs."""
    return [
        {
            "kind": row.kind,
            "machines": row.machines,
            "clear": row.clear,
            "right": row.right,
            "alone": row.alone,
            "explained": row.explained,
            "explained_of_all_sizes": row.explained_at_all,
            "hinted": row.hinted,
            "said": dict(sorted(row.said.items())),
        }
        for row in rows
    ]


def _one(drawn_by: tuple[tuple[str, ...], int]) -> Outcome:
    kinds, seed = drawn_by
    robot = Robot.default()
    drawn = draw(robot, kinds, seed)
    try:
        found = WeighedFindings(weighed(robot, drawn.walk, drawn.fresh))
    except InputRefused as refusal:
        return Outcome(_clear(drawn), f"refused: {str(refusal)[:40]}", False, False, False, False)
    return replace(judge(drawn, found), errors=before_and_after(robot, drawn, found))


def judge(drawn: Drawn, found: WeighedFindings) -> Outcome:
    """Compare what was found with what is in the machine."""
    sets = [{(n.effect, n.joint) for n in (effect.name, *effect.aliases)} for effect in found.effects]
    wanted = list(drawn.truth)
    named = ", ".join(sorted(effect.label for effect in found.effects))
    verdict = found.decision.verdict
    explained = verdict == "explained" and found.decision.confirmed is True
    if not wanted:
        right = verdict == "adequate" and not sets
    else:
        right = (
            explained
            and all(any(cause in s for s in sets) for cause in wanted)
            and all(any(cause in s for cause in wanted) for s in sets)
        )
    return Outcome(
        clear=_clear(drawn),
        said=f"{verdict}: {named}" if named else verdict,
        right=right,
        alone=right and all(len(s) == 1 for s in sets),
        explained=explained,
        hinted=bool(found.hints) and [found.hints[0].depends_on] == [OUTSIDE.get(e) for e, _ in wanted],
    )


def _clear(drawn: Drawn) -> bool:
    return all(size > CLEAR_SDS * SCATTER_UM for size in drawn.size_um)


def _count(row: Row, outcome: Outcome) -> None:
    row.machines += 1
    row.said[outcome.said] += 1
    row.explained_at_all += outcome.explained
    if outcome.clear:
        row.clear += 1
        row.right += outcome.right
        row.alone += outcome.alone
        row.explained += outcome.explained
        row.hinted += outcome.hinted
        if outcome.errors is not None and (outcome.explained or row.kind in OUTSIDE or row.kind == CLEAN):
            row.errors.append(outcome.errors)


PAGE = """# The diagnosis against random machines

`station confusion --markdown FILE` makes this page: {machines} machines of each kind, seed {seed}.
Every machine is measured as a run of plan `diagnostic` measures it: 120 readings with their run-ups, then
40 fresh ones with the zero offsets taken off the commands, one sample a reading.  It has random
zero offsets, geometric errors, joints, phases, moments and sizes (1 to 30 um of projected RMS, evenly in the
logarithm); the emulator's physics share nothing with the catalogue.

- *clear*: more than three times the noise of 1.1 um.
- *right*: explained and confirmed on 40 fresh readings, every cause within the alias set of a finding and
  nothing else blamed; for clean machines, adequate with no finding.
- *confirmed*: explained and confirmed, whatever the cause; for causes of the catalogue only.
- *hint*: the strongest one, where the cause is outside the catalogue.

| | share |
|---|---|
| in the catalogue and clear: right | {right} |
| the least of all kinds | {least} |
| clean: something blamed | {blamed} |
| outside the catalogue and clear: confirmed | {wrong} |
| outside, of all sizes: confirmed | {wrong_at_all} |
| outside and clear: strongest hint right | {hinted} |

| in the machine | clear | right | with no alias | confirmed, clear | confirmed, all | hint right | most |
|---|---|---|---|---|---|---|---|
{machine_lines}

## Before and after
RMS over all clear machines of a kind; of causes in the catalogue over those explained and confirmed, of
others over every one.  Before is the base model, after the model that the diagnosis trusts, all frozen.

- *reading*: 40 fresh readings less predicted, um; those left out by name excepted.
- *position*: where the emulated machine truly stands less where it was sent, um, over a grid of 7 x 5 places
  with random approaches.  What clean machines keep is what one distance and the tolerances leave open.

| in the machine | machines | reading before | after | after over noise | position before | after |
|---|---|---|---|---|---|---|
{error_lines}
"""


def markdown(rows: list[Row], seed: int) -> str:
    """docs/confusion.md."""
    clean = next(row for row in rows if row.kind == CLEAN)
    outside = [row for row in rows if row.kind in OUTSIDE]
    inside = [row for row in rows if row.kind not in OUTSIDE and row is not clean]
    worst = min((r for r in inside if r.clear), key=lambda r: r.right / r.clear, default=clean)
    clear = sum(row.clear for row in outside)
    return PAGE.format(
        machines=clean.machines,
        seed=seed,
        right=_share(sum(r.right for r in inside), sum(r.clear for r in inside)),
        least=f"{_share(worst.right, worst.clear)} ({worst.kind})",
        blamed=_share(sum(n for text, n in clean.said.items() if ": " in text), clean.machines),
        wrong=_share(sum(r.explained for r in outside), clear),
        wrong_at_all=_share(sum(r.explained_at_all for r in outside), sum(r.machines for r in outside)),
        hinted=_share(sum(r.hinted for r in outside), clear),
        machine_lines="\n".join(_line(row) for row in rows),
        error_lines="\n".join(_errors_line(row) for row in rows),
    )


def _share(part: int, whole: int) -> str:
    return f"{part} of {whole}, {100.0 * part / max(whole, 1):.1f} %"


def _line(row: Row) -> str:
    right, hint = f"{row.right}/{row.clear}", "-"
    if row.kind in OUTSIDE:
        right, hint = hint, f"{row.hinted}/{row.clear}"
    most = "; ".join(f"{text} ({count})" for text, count in row.said.most_common(3))
    return (
        f"| {row.kind} | {row.clear} | {right} | {row.alone} | {row.explained}/{row.clear} "
        f"| {row.explained_at_all}/{row.machines} | {hint} | {most} |"
    )


def _errors_line(row: Row) -> str:
    reading = _pooled([e.reading_um for e in row.errors])
    position = _pooled([e.position_um for e in row.errors])
    ratio = reading[1] / SCATTER_UM
    return (
        f"| {row.kind} | {len(row.errors)} | {reading[0]:.2f} | {reading[1]:.2f} | {ratio:.2f} "
        f"| {position[0]:.0f} | {position[1]:.0f} |"
    )


def _pooled(rms: list[tuple[float, float]]) -> Real:
    """(2,) RMS over all."""
    return np.sqrt(np.mean(np.square(rms), axis=0)) if rms else np.full(2, np.nan)
