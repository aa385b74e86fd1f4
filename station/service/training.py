"""The training desk: the emulated machine has an error; does the station find it?

A hidden error is revealed on request, or when a run has ended with its own finding.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from random import Random, SystemRandom
from threading import Lock

from station.errors import FieldRefused, NotApplicable, NotFound
from station.motion import EmulatedRig
from station.records import (
    Blamed,
    CalibrationSummary,
    ChallengeGroup,
    DiagnosisDocument,
    Exercise,
    Said,
    Score,
    TrainingView,
)
from station.service.challenges import KINDS, Kind
from station.service.scoring import scored
from station.store import Store

MEASURING = ("calibrate", "diagnose", "separate", "check")
"""Kinds of runs that give information about the machine."""
_LOOKED_AT = 20


@dataclass(slots=True)
class _Exercise:
    n: int
    kind: Kind
    joint: int | None
    size: float | None
    unseen: bool
    after_run: int
    """Runs with a higher number belong to it."""
    revealed: bool = False
    repaired: bool = False
    said: Said | None = None
    score: Score | None = None


class TrainingDesk:
    """Thread safe. Its memory lasts for the current session of the service."""

    def __init__(
        self,
        rig: EmulatedRig,
        store: Store,
        running: Callable[[], int | None],
        rng: Random | None = None,
    ) -> None:
        """:param running: the run that holds the rig"""
        self._rig, self._store, self._running = rig, store, running
        self._rng = rng or SystemRandom()
        self._lock = Lock()
        self._exercises: list[_Exercise] = []

    def view(self) -> TrainingView:
        """Everything that may be shown now."""
        with self._lock:
            for exercise in self._exercises:
                self._look(exercise)
            told = [_told(exercise) for exercise in reversed(self._exercises)]
        current = next((e for e in told[:1] if not e.repaired), None)
        return TrainingView(
            challenges=tuple(kind.shown() for kind in KINDS.values()),
            current=current,
            done=tuple(e for e in told if e is not current),
        )

    def choose(self, kind: str, joint: int | None, size: float | None) -> TrainingView:
        """Give the machine this error from now on, and no other.

        :raises FieldRefused: no such kind, joint or size.
        :raises NotApplicable: a run is active.
        """
        if kind not in KINDS:
            raise FieldRefused("kind", f"There is no challenge {kind}; there is {', '.join(KINDS)}.")
        wanted = KINDS[kind]
        if wanted.joint and joint not in (1, 2):
            raise FieldRefused("joint", "Give the joint, 1 or 2.")
        if wanted.sizes is not None:
            size = wanted.sizes[1] if size is None else size
            if not wanted.sizes[0] <= size <= wanted.sizes[2]:
                bounds = f"{wanted.sizes[0]:g} to {wanted.sizes[2]:g} {wanted.unit}"
                raise FieldRefused("size", f"The size must be {bounds}.")
        self._begin(wanted, joint if wanted.joint else None, size if wanted.sizes else None, unseen=False)
        return self.view()

    def draw(self, groups: Sequence[ChallengeGroup]) -> TrainingView:
        """Give the machine a hidden error of these groups. :raises NotApplicable: a run is active."""
        kind = self._rng.choice([kind for kind in KINDS.values() if kind.group in groups])
        joint = self._rng.choice((1, 2)) if kind.joint else None
        size = None
        if kind.sizes is not None:
            usual, largest = kind.sizes[1], kind.sizes[2]
            size = float(f"{self._rng.uniform(usual, largest):.2g}")
        self._begin(kind, joint, size, unseen=True)
        return self.view()

    def reveal(self) -> TrainingView:
        """Reveal the last hidden error. Repeating it is harmless. :raises NotFound: there is no exercise."""
        self._last().revealed = True
        return self.view()

    def repair(self) -> TrainingView:
        """Remove all ordered errors from the machine."""
        self._rig.order([])
        self._rig.order_effects([])
        self._end_all()
        return self.view()

    @property
    def hides(self) -> bool:
        """Whether a hidden error is not revealed yet."""
        current = self.view().current
        return current is not None and not current.revealed

    def _begin(self, kind: Kind, joint: int | None, size: float | None, *, unseen: bool) -> None:
        if (run := self._running()) is not None:
            raise NotApplicable(f"Run {run} is under way; wait for its end or abort it.")
        self._rig.order(kind.faults(joint))
        self._rig.order_effects(kind.effects(joint, size))
        newest = self._store.last_on_rig()
        self._end_all()
        after_run = newest.id if newest is not None else 0
        with self._lock:
            number = len(self._exercises) + 1
            self._exercises.append(_Exercise(number, kind, joint, size, unseen, after_run))

    def _end_all(self) -> None:
        with self._lock:
            for exercise in self._exercises:
                self._look(exercise)
                exercise.repaired = True

    def _last(self) -> _Exercise:
        with self._lock:
            if not self._exercises:
                raise NotFound("There is no exercise yet; choose a challenge first.")
            return self._exercises[-1]

    def _look(self, exercise: _Exercise) -> None:
        """The result of the last run; results after the repair belong to another machine."""
        if exercise.repaired:
            return
        known = exercise.said.run if exercise.said else exercise.after_run
        ended = (
            run
            for run in self._store.calibrations(limit=_LOOKED_AT).items
            if run.id > known and run.state.ended and run.kind in MEASURING
        )
        if (run := next(ended, None)) is not None:
            document = self._document(run.id)
            exercise.said = _said(run, document)
            exercise.score = scored(exercise.kind, exercise.joint, run, document)

    def _document(self, run: int) -> DiagnosisDocument | None:
        try:
            return self._store.diagnosis(run)
        except NotFound:
            return None


def _said(run: CalibrationSummary, document: DiagnosisDocument | None) -> Said:
    return Said(
        run=run.id,
        state=run.state,
        verdict=run.verdict,
        outcome=run.outcome,
        reason=run.reason,
        diagnosis=document.verdict if document else None,
        confirmed=document.confirmed if document else None,
        causes=tuple(
            Blamed(effect=f.effect, joint=f.joint, part=f.part, probability=f.probability)
            for f in (document.findings if document else ())
        ),
    )


def _told(exercise: _Exercise) -> Exercise:
    revealed = exercise.revealed or not exercise.unseen or exercise.said is not None or exercise.repaired
    return Exercise(
        n=exercise.n,
        unseen=exercise.unseen,
        revealed=revealed,
        challenge=exercise.kind.shown() if revealed else None,
        joint=exercise.joint if revealed else None,
        size=exercise.size if revealed else None,
        repaired=exercise.repaired,
        said=exercise.said,
        score=exercise.score,
    )
