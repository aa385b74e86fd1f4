"""What is said of one random machine, and whether it is true."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from station.diagnosis import ExplanationSet, WeighedFindings, weighed
from station.errors import InputRefused
from station.five_bar import Robot
from station.studies.confusion.errors import BeforeAndAfter, before_and_after
from station.studies.confusion.kinds import OUTSIDE
from station.studies.confusion.machines import SCATTER_UM, Drawn, draw

CLEAR_SDS = 3.0
"""An effect counts as clearly visible when its projected RMS is this many times the noise."""
SPOKEN_OF = 0.02
"""Least probability of a statement that is counted."""


@dataclass(frozen=True)
class Zeros:
    """The zero offsets found, beside the true ones."""

    off_sd: tuple[float, float]
    """Found less true, in standard uncertainties."""
    sd_deg: float
    """Mean of both."""

    @property
    def inside_95(self) -> int:
        return sum(abs(off) < 1.96 for off in self.off_sd)


@dataclass(frozen=True)
class Outcome:
    """What the diagnosis made of one machine."""

    clear: bool
    said: str
    """Verdict, and the effects named."""
    right: bool
    """Every cause within its alias set, nothing else blamed, confirmed; of clean machines, adequate."""
    alone: bool
    """Right, and every set has one member."""
    first: bool
    """The most probable explanation holds just the causes; of errors without a name, one without a name."""
    confirmed: bool
    """Explained and confirmed, whatever the cause."""
    wrong: bool
    """Confirmed, and something is blamed that is not there and can be distinguished from what is."""
    hinted: bool
    """The strongest hint is on what the error depends on."""
    statements: tuple[tuple[float, bool], ...] = ()
    """Probability of each effect that was spoken of, and whether it is there."""
    zeros: Zeros | None = None
    errors: BeforeAndAfter | None = None
    """None where nothing was diagnosed."""


def outcome(drawn_by: tuple[tuple[str, ...], int]) -> Outcome:
    """Of the machine of these kinds with this seed."""
    kinds, seed = drawn_by
    robot = Robot.default()
    drawn = draw(robot, kinds, seed)
    try:
        found = WeighedFindings(weighed(robot, drawn.sequence, drawn.fresh))
    except InputRefused as refusal:
        said = f"refused: {str(refusal)[:40]}"
        return Outcome(_clear(drawn), said, False, False, False, False, False, False)
    return judge(drawn, found, before_and_after(robot, drawn, found))


def judge(drawn: Drawn, found: WeighedFindings, errors: BeforeAndAfter | None = None) -> Outcome:
    """Compare what was found with what is in the machine."""
    sets = [{(n.effect, n.joint) for n in (effect.name, *effect.aliases)} for effect in found.effects]
    named = ", ".join(sorted(effect.label for effect in found.effects))
    verdict = found.decision.verdict
    confirmed = verdict == "explained" and found.decision.confirmed is True
    if drawn.kinds:
        right = (
            confirmed
            and bool(drawn.truth)
            and all(any(cause in s for s in sets) for cause in drawn.truth)
            and all(s & drawn.truth for s in sets)
        )
    else:
        right = verdict == "adequate" and not sets
    depends_on = {OUTSIDE[k] for k in drawn.kinds if k in OUTSIDE}
    return Outcome(
        clear=_clear(drawn),
        said=f"{verdict}: {named}" if named else verdict,
        right=right,
        alone=right and all(len(s) == 1 for s in sets),
        first=_first(drawn, found.found),
        confirmed=confirmed,
        wrong=confirmed and any(not s & drawn.truth for s in sets),
        hinted=bool(found.hints) and {found.hints[0].depends_on} == depends_on,
        statements=_statements(drawn, found.found),
        zeros=_zeros(drawn, found.found),
        errors=errors,
    )


def _clear(drawn: Drawn) -> bool:
    return all(size > CLEAR_SDS * SCATTER_UM for size in drawn.size_um)


def _first(drawn: Drawn, found: ExplanationSet) -> bool:
    """Of the explanations by the families that they hold."""
    families = [found.weighing.families[k] for k in found.statements.cores[0][0]]
    if drawn.kinds and not drawn.truth:
        return not families or any(not family.named for family in families)
    return {(part[0], part[1]) for family in families for part in family.keys} == drawn.truth


def _statements(drawn: Drawn, found: ExplanationSet) -> tuple[tuple[float, bool], ...]:
    stated = found.statements.marginals.items()
    return tuple((p, (part[0], part[1]) in drawn.truth) for part, p in stated if p >= SPOKEN_OF)


def _zeros(drawn: Drawn, found: ExplanationSet) -> Zeros:
    sd = np.array([q.sd for q in found.parameters[:2]])
    off = (np.array([q.value for q in found.parameters[:2]]) - np.degrees(drawn.machine.truth[:2])) / sd
    return Zeros((float(off[0]), float(off[1])), float(np.mean(sd)))
