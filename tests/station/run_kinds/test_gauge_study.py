"""A gauge study: operators in turn, again after an interruption, and what the scatter comes from."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from station.errors import NotApplicable
from station.five_bar import SCALE_SD_MM, Robot
from station.plans import make_plan
from station.records import CalibrationRequest, PlanName, Reading, State, Stop, StudyDesign
from station.run_kinds import RUN_KINDS, gauge_study, station_gauge
from station.service import Orchestrator
from station.store import Store
from station.studies.population.physics import PlainMachine
from station.studies.simulation import SAMPLES
from tests.station.asking import asked
from tests.station.conftest import SETTINGS
from tests.station.fakes import Rig
from tests.station.service.test_waiting import LIMIT_S, prompt_of

DESIGN = StudyDesign(operators=2, mountings=2, repeats=2)
STOPS = 6
LIMIT_DEG = 0.5
MOUNTING_SD_MM = 0.5


@pytest.fixture(autouse=True)
def short(monkeypatch: pytest.MonkeyPatch) -> None:
    """Six positions in the place of 120 readings."""
    monkeypatch.setattr(gauge_study, "make_plan", lambda _, robot: make_plan("rapid", robot))


@pytest.fixture
def orchestrator(store: Store, rig: Rig) -> Iterator[Orchestrator]:
    rng = np.random.default_rng(1)
    rig.scale.noise_mm = lambda: float(rng.normal(0.0, 1e-3))
    made = Orchestrator(rig.devices, store, SETTINGS, RUN_KINDS)
    yield made
    made.shutdown()


def confirm(orchestrator: Orchestrator, run: int, who: str) -> str:
    """The next prompt of a run, confirmed."""
    prompt = prompt_of(orchestrator, run)
    orchestrator.answer(run, prompt.id, None, who)
    return prompt.text


def test_it_goes_on_after_the_last_mounting_that_was_finished(
    orchestrator: Orchestrator, store: Store, rig: Rig
) -> None:
    mounted: list[int] = []
    object.__setattr__(rig.devices, "remount", lambda c, mounting: mounted.append(mounting))
    first = orchestrator.submit(asked("R1", "gauge_study", study=DESIGN)).id
    assert confirm(orchestrator, first, "ada").startswith("Operator 1 of 2: take the mechanism off")
    assert confirm(orchestrator, first, "bob").startswith("Operator 2 of 2")
    prompt_of(orchestrator, first)
    orchestrator.abort(first)
    assert orchestrator.wait(first, LIMIT_S) is State.ABORTED
    assert len(store.readings(first)) == 2 * DESIGN.repeats * STOPS
    with pytest.raises(NotApplicable, match="no finished gauge study"):
        station_gauge(store, [first], LIMIT_DEG)

    second = orchestrator.follow("gauge_study", first, "eva").id
    confirm(orchestrator, second, "ada")
    confirm(orchestrator, second, "cyd")
    assert orchestrator.wait(second, LIMIT_S) is State.SUCCEEDED, store.summary(second).reason
    summary = store.summary(second)
    assert (summary.verdict, summary.outcome, summary.reason_code) == (None, "good", "gauge_studied")
    readings = store.readings(second)
    assert [r.reading for r in readings] == list(range(1, 8 * STOPS + 1))
    assert readings[: 4 * STOPS] == store.readings(first)
    assert mounted == [0, 1, 2, 0, 3, 4]
    found = station_gauge(store, [second], LIMIT_DEG)
    assert found.people == (("ada",), ("bob", "cyd"))
    assert [(v.operator, v.mounting, v.repeat) for v in found.values] == [
        (o, m, r) for o in (1, 2) for m in (1, 2) for r in (1, 2)
    ]
    assert summary.reason_params["sd1_deg"] == pytest.approx(found.joints[0].grr)
    # nothing of it is a calibration
    assert store.trend(limit=10) == [] and store.memory("R1") is None
    with pytest.raises(NotApplicable, match="is finished"):
        orchestrator.follow("gauge_study", second, "eva")
    store.save_robot(Robot(serial="R1", L=(375.1, 375.0)))
    with pytest.raises(NotApplicable, match="has changed since"):
        orchestrator.follow("gauge_study", first, "eva")


def readings_of(stops: tuple[Stop, ...], robot: Robot, seed: int, design: StudyDesign) -> list[Reading]:
    """Of a whole study; each mounting has an error of its own."""
    rng = np.random.default_rng(seed)
    truth = np.concatenate([np.radians([0.3 * seed, -0.3 * seed]), np.zeros(8), robot.drm])
    readings: list[Reading] = []
    for mounting in range(design.all_mountings):
        truth[10:] = np.array(robot.drm) + rng.normal(0.0, MOUNTING_SD_MM, 2)
        for repeat in range(design.repeats):
            taken = PlainMachine(robot, truth).read(stops, rng)
            noise = rng.normal(0.0, SCALE_SD_MM, (len(stops), SAMPLES))
            samples = taken.distance[:, None] + noise - noise.mean(axis=1, keepdims=True)
            readings += [
                Reading(
                    len(readings) + k + 1,
                    float(taken.t_s[k]),
                    tuple(np.degrees(taken.theta[k]).tolist()),
                    stop.approach,
                    float(taken.distance[k]),
                    stop.position,
                    design.sequence_of(mounting, repeat),
                    tuple(samples[k].tolist()),
                )
                for k, stop in enumerate(stops)
            ]
    return readings


def kept(store: Store, serial: str, seed: int, design: StudyDesign = DESIGN, plan: PlanName = "full") -> int:
    """A finished study, with the stops of a plan."""
    robot = Robot.default(serial)
    request = CalibrationRequest(serial, "gauge_study", "ada", "gauge_study", study=design)
    run = store.create(request, robot)
    store.set_state(run, State.RUNNING)
    store.add_readings(run, readings_of(make_plan(plan, robot).stops, robot, seed, design))
    store.finish(run, State.SUCCEEDED, judged=False)
    return run


def test_what_the_scatter_comes_from(store: Store) -> None:
    """Mountings that differ by 0.5 mm scatter far more than readout, drives and solver do."""
    runs = [kept(store, f"R{k}", k) for k in range(2)]
    found = station_gauge(store, runs, LIMIT_DEG)
    assert found.joints[0].against == "robots" and found.joints[0].pv == pytest.approx(0.3 / 2**0.5, rel=0.1)
    for joint in found.joints:
        sources = joint.sources
        assert sources.percent["mounting"] + sources.percent["operators"] > 50.0
        assert sources.solver < 1e-6 < sources.readout
        assert sum(sources.percent.values()) == pytest.approx(100.0)
        # what the readings foretell is what the repeats show
        assert np.hypot(sources.readout, sources.drives) == pytest.approx(joint.repeat, rel=0.6)
    alone = station_gauge(store, runs[:1], LIMIT_DEG).joints[0]
    assert alone.against == "tolerance" and alone.tv == pytest.approx(2 * LIMIT_DEG / 6.0)
    assert alone.tolerance_percent == pytest.approx(alone.grr_percent)


def test_runs_that_are_no_study_together(store: Store) -> None:
    one, same = kept(store, "R1", 1, plan="rapid"), kept(store, "R1", 2, plan="rapid")
    other = kept(store, "R2", 3, StudyDesign(operators=3), "rapid")
    for runs, why in (([one, same], "Robot R1 is in two"), ([one, other], "differ in operators")):
        with pytest.raises(NotApplicable, match=why):
            station_gauge(store, runs, LIMIT_DEG)
