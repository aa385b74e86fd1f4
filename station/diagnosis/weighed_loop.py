"""The set of explanations of a five-bar's readings, and the mistakes in its files (method.md section 4).

Mistakes come first: wrong readings or angles are refused, a wrong label is ignored. Where the explanations do
not account for the readings, small wrong entries are searched as well.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from station.diagnosis.decision import Decision
from station.diagnosis.explanations import ExplanationSet, explain, together
from station.diagnosis.mistakes import Context, Mistake, MistakeRefused, find_mistake
from station.diagnosis.readiness import check_enough, checked_fresh
from station.errors import InputRefused
from station.fitting import NotConvergedError, Outlier
from station.five_bar import FiveBar, Robot, check_places
from station.records import DiagnosisVerdict, Measurements, phrase

SURE = 0.95
FEW_GLITCHES = 0.05
"""Share of the readings of a file that may be excluded by id without an effect on the confirmation."""

Change = Callable[[Measurements], Measurements]


@dataclass(frozen=True)
class WeighedDiagnosis:
    """The result for one residual."""

    robot: Robot
    measurements: Measurements
    """The readings that were used, without the fresh ones."""
    fresh: Measurements | None
    """The fresh readings that were used."""
    found: ExplanationSet
    mistake: Mistake | None
    """A wrong label, or glitches, that were excluded."""
    entry: Mistake | None
    """A wrong entry of the size of an effect: reported with the effect."""
    outliers: tuple[Outlier, ...]
    fresh_outliers: tuple[int | str, ...]

    @cached_property
    def decision(self) -> Decision:
        """Verdict and confirmation; a file with a mistake confirms nothing."""
        decided = self.found.decision
        return Decision(decided.verdict, False if self.spoilt else decided.confirmed)

    @property
    def spoilt(self) -> bool:
        """Whether a mistake discredits the file; any device gives a disturbed reading occasionally."""
        if self.mistake is None:
            return False
        readings = self.measurements if self.mistake.file == "readings" else self.fresh
        few = FEW_GLITCHES * (len(self.mistake.rows) + (0 if readings is None else len(readings)))
        return self.mistake.kind != "glitches" or len(self.mistake.rows) > few

    @property
    def verdict(self) -> DiagnosisVerdict:
        return self.decision.verdict

    @property
    def confirmed(self) -> bool | None:
        """Whether independent fresh readings agree with the finding; None without any."""
        return self.decision.confirmed


@dataclass(frozen=True)
class _Files:
    """The files to diagnose, without columns or rows that are known to be wrong."""

    sequence: Measurements
    fresh: Measurements | None
    labelled: bool = True
    """Whether the labels of positions can be trusted."""

    def without(self, mistake: Mistake) -> _Files:
        """The same files without the columns or rows that a mistake has spoiled."""
        match mistake.kind:
            case "position_labels" if mistake.file == "fresh":
                return replace(self, fresh=_each(self.fresh, _unlabelled))
            case "position_labels":
                return replace(self, sequence=_unlabelled(self.sequence), labelled=False)
            case "approach_sign" | "approach_missing":
                return replace(
                    self, sequence=_undirected(self.sequence), fresh=_each(self.fresh, _undirected)
                )
            case "time" if mistake.file == "fresh":
                return replace(self, fresh=_each(self.fresh, _untimed))
            case "time":
                return replace(self, sequence=_untimed(self.sequence), fresh=_each(self.fresh, _untimed))
        if mistake.file == "fresh":
            return replace(self, fresh=None if self.fresh is None else _left(self.fresh, mistake))
        return replace(self, sequence=_left(self.sequence, mistake))


def weighed(
    robot: Robot,
    measurements: Measurements,
    fresh: Measurements | None = None,
    context: Context | None = None,
) -> WeighedDiagnosis:
    """Mistakes, explanations, decision.

    :param context: what the files recorded; if omitted, it is inferred from the numbers
    :raises MistakeRefused: readings, angles or the robot file are wrong in a way that can be named.
    :raises InputRefused: the readings are malformed or too few; the error states what is missing.
    """
    context = context or Context.of(measurements)
    mistake = _mistake(robot, measurements, fresh, context, explained=True)
    files = _Files(measurements, _distinct(fresh, measurements))
    entry = None
    if mistake is not None and mistake.severity == "as_effect":
        mistake, entry = None, mistake
    elif mistake is not None:
        files = files.without(mistake)
    found, files = _explained(robot, files)
    if found.decision.verdict not in ("adequate", "explained"):
        late = _mistake(robot, files.sequence, files.fresh, context, explained=False)
        if late is not None and late.severity == "as_effect":
            entry = late
        elif late is not None and mistake is None:
            mistake = late
            found, files = _explained(robot, files.without(late))
    shown = _mistake_shown_by(found, files)
    if shown is not None:
        raise MistakeRefused(shown)
    held = set(found.weighing.mechanism.measurements.ids)
    fresh_ids = () if files.fresh is None else files.fresh.ids
    return WeighedDiagnosis(
        robot=robot,
        measurements=_kept(files.sequence, held),
        fresh=None if files.fresh is None else _kept(files.fresh, held),
        found=found,
        mistake=mistake,
        entry=entry,
        outliers=_outliers(robot, measurements, found),
        fresh_outliers=tuple(i for i in fresh_ids if i not in held),
    )


def _mistake(
    robot: Robot, sequence: Measurements, fresh: Measurements | None, context: Context, *, explained: bool
) -> Mistake | None:
    """:raises MistakeRefused: the mistake has to be corrected first."""
    found = find_mistake(robot, sequence, fresh, context, explained=explained)
    if found is not None and found.severity == "refused":
        raise MistakeRefused(found)
    return found


def _explained(robot: Robot, files: _Files) -> tuple[ExplanationSet, _Files]:
    """The explanations, and the files with the same numbers for their mounts.

    :raises InputRefused: the files cannot be judged.
    """
    mechanism = FiveBar(robot, files.sequence)
    backwards = np.flatnonzero(np.diff(files.sequence.t_s) < 0)
    if backwards.size:
        raise InputRefused(
            f"Reading {files.sequence.ids[int(backwards[0]) + 1]}, column t_s: time runs backwards; "
            "put the rows in the order they were measured."
        )
    mechanism.check()
    check_places(files.sequence)
    check_enough(mechanism, labelled=files.labelled)
    fresh = None if files.fresh is None else checked_fresh(mechanism, files.fresh)
    try:
        return explain(mechanism, fresh), replace(files, fresh=fresh)
    except NotConvergedError as error:
        raise InputRefused(
            f"The identification did not converge ({error}); check that angles and distances belong together."
        ) from error


def _mistake_shown_by(found: ExplanationSet, files: _Files) -> Mistake | None:
    """A change to the machine between readings, as the explanations show it."""
    fresh, validation = files.fresh, found.validation
    if fresh is None or validation is None or not found.explanations:
        return None
    if not validation.new:
        return Mistake("same_readings", phrase("not_fresh"), fresh.ids, "refused", "fresh")
    best = found.explanations[0]
    slips = [held for held in best.errors if held.part.effect == "count_slip"]
    moments = {q.value for held in slips for q in held.parameters if q.name == "from_s"}
    if best.probability < SURE or len(moments) != 1 or len(slips) != len(best.errors):
        return None
    moment, joints = moments.pop(), [held.part.joint for held in slips if held.part.joint is not None]
    sizes = tuple(
        phrase("small_degrees", value=q.value)
        for held in slips
        for q in held.parameters
        if q.name == "step_deg"
    )
    clock = together(files.sequence, fresh).t_s
    if moment == clock[len(files.sequence)] and not validation.agrees:
        which = tuple(phrase("joint", number=joint) for joint in joints)
        said = phrase("homed_before_fresh", joints=which, sizes=sizes)
        return Mistake(
            "zeros_written" if len(joints) == 2 else "rehomed", said, fresh.ids, "refused", "fresh"
        )
    if len(joints) == 2 and moment in files.sequence.t_s:
        rows = tuple(i for i, t in zip(files.sequence.ids, files.sequence.t_s, strict=True) if t >= moment)
        said = phrase("shifted_within", reading=phrase("reading", id=rows[0]), sizes=sizes)
        return Mistake("zeros_written", said, rows, "refused")
    return None


def _outliers(robot: Robot, sequence: Measurements, found: ExplanationSet) -> tuple[Outlier, ...]:
    """Readings of the sequence that were not used, glitches included."""
    held = set(found.weighing.mechanism.measurements.ids)
    out = np.array([i not in held for i in sequence.ids])
    if not out.any():
        return ()
    residual_mm, sd_mm = found.left_by(FiveBar(robot, sequence))
    return tuple(
        Outlier(sequence.ids[k], float(residual_mm[k]), float(abs(residual_mm[k]) / sd_mm[k]))
        for k in np.flatnonzero(out)
    )


def _distinct(fresh: Measurements | None, sequence: Measurements) -> Measurements | None:
    """Fresh readings with unique ids."""
    if fresh is None or not set(fresh.ids) & set(sequence.ids):
        return fresh
    return replace(fresh, ids=tuple(f"fresh {i}" for i in fresh.ids))


def _kept(m: Measurements, held: set[int | str]) -> Measurements:
    kept = np.array([i in held for i in m.ids])
    return m if kept.all() else m.take(kept)


def _left(m: Measurements, mistake: Mistake) -> Measurements:
    """The readings without the rows of a mistake."""
    rows = {*mistake.rows, *(f"fresh {i}" for i in mistake.rows)}
    return m.take(np.array([i not in rows for i in m.ids]))


def _each(m: Measurements | None, change: Change) -> Measurements | None:
    return None if m is None else change(m)


def _unlabelled(m: Measurements) -> Measurements:
    return replace(m, position=np.arange(len(m)))


def _undirected(m: Measurements) -> Measurements:
    return replace(m, approach=np.zeros_like(m.approach))


def _untimed(m: Measurements) -> Measurements:
    return replace(m, t_s=np.arange(len(m), dtype=float))
