"""Look-alikes told apart by motion, on machines in virtual time: the set shrinks and keeps the truth."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from station.diagnosis.separating import COUNTS, experiment
from station.errors import InputRefused, NotApplicable, NotFound
from station.records import CalibrationResult, Reading, State
from station.run_kinds.diagnose import diagnosed
from station.run_kinds.separate import planned, separating
from station.store.store import Store
from tests.station.asking import asked
from tests.station.run_kinds.test_diagnose import BACKLASH, ROBOT, machine, run
from tests.station.simulated import carried_out

DRIFT = {"kind": "drift", "mm_per_hour": 0.5}


def alias_set(result: CalibrationResult) -> list[tuple[str, int | None]]:
    (finding,) = result.findings
    return [(member.effect, member.joint) for member in finding.alias_set]


def test_the_set_is_smaller_afterwards_and_holds_the_truth() -> None:
    measured = machine(DRIFT)
    readings, found = run(measured)
    before = alias_set(found)
    assert {effect for effect, _ in before} == {"drift", "thermal_growth"}
    more, separated = carried_out(measured, separating(ROBOT, readings), before=120)
    assert alias_set(separated)[0] == ("drift", None)
    assert len(alias_set(separated)) < len(before)
    # the motion was more probable to decide than not, which is no promise
    assert separated.verdict == "fail"
    assert separated.outcome in ("repair", "ambiguous")
    assert more[0].reading == 121
    assert sum(r.sequence == 1 for r in more) in COUNTS
    # fresh positions are judged by, never learned from
    assert len(separated.residuals) == 120 + sum(r.sequence == 1 for r in more)


def test_no_longer_a_walk_than_needed_is_planned_and_only_within_the_workspace() -> None:
    readings, _ = run(machine(DRIFT))
    found = experiment(diagnosed(ROBOT, readings))
    assert found is not None
    assert {"thermal_growth of the links", "unnamed error over time"} & set(found.apart)
    assert len(found.stops) in COUNTS
    assert found.decides > 0.3
    for stop in found.stops:
        x, y = stop.target_mm
        assert ROBOT.workspace_x[0] < x < ROBOT.workspace_x[1]
        assert ROBOT.workspace_y[0] < y < ROBOT.workspace_y[1]
        assert all(stop.approach)
    places = np.array([complex(*stop.target_mm) for stop in found.stops])
    assert np.abs(np.diff(places)).mean() < 200.0


def test_none_is_offered_where_nothing_is_left_to_decide() -> None:
    """Play has no alternative."""
    readings, _ = run(machine(BACKLASH))
    assert experiment(diagnosed(ROBOT, readings)) is None
    with pytest.raises(InputRefused, match="No further motion"):
        next(separating(ROBOT, readings))


def test_what_is_not_the_cause_is_not_worth_separating() -> None:
    drag = {"kind": "cable_drag", "joint": 1, "deg_at_end": 0.01}
    readings, _ = run(machine(drag))
    assert experiment(diagnosed(ROBOT, readings)) is None


class Kept:
    """A store with the diagnostic run of a warming machine."""

    def __init__(self, path: Path) -> None:
        self.store = Store(path / "station.db")
        self.run = self.keep(*run(machine(DRIFT)))

    def keep(self, readings: list[Reading], result: CalibrationResult, plan: Any = "diagnostic") -> int:
        return self.store.add_run(asked("R1", plan), ROBOT, readings, result)


def test_why_a_run_cannot_be_gone_on_from(tmp_path: Path) -> None:
    kept = Kept(tmp_path)
    store = kept.store
    plan = planned(store, kept.run)
    assert "unnamed error over time" in plan.experiment.apart
    assert 10.0 < plan.duration_s < 600.0
    unapplied = store.create(asked("R1", "paper"), ROBOT)
    store.finish(unapplied, State.ABORTED)
    with pytest.raises(NotFound, match="has no diagnosis"):
        planned(store, unapplied)
    imported = kept.keep(*run(machine(DRIFT)), plan="import")
    with pytest.raises(NotApplicable, match="imported from a file"):
        planned(store, imported)
    clear = kept.keep(*run(machine(BACKLASH)))
    with pytest.raises(NotApplicable, match="No further motion"):
        planned(store, clear)
    apply = store.create(asked("R1", "apply", of=unapplied), ROBOT)
    store.begin_zero_write(apply, 1, 0.8, 0.8)
    with pytest.raises(NotApplicable, match=f"Run {apply} has changed the drives. zeros"):
        planned(store, kept.run)
    store.close()
