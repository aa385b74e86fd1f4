"""Requests of people and programs in virtual time: served by the application, and ended by a kill."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from random import Random

import pytest

from drivers.emulated.spec import MachineSpec
from station.simulation.people import People
from station.simulation.plant import NotRunning, Plant
from station.simulation.site import Site
from station.simulation.years import prepared

SPEC = MachineSpec(seed=3, zero_offsets_deg=(0.7, -0.4), drm_mm=(1.1, 0.4))
ORDER = {"robot_serial": "SIM-1", "plan": "rapid", "operator": "Ada"}
SECOND = Site(servo="orientalmotor", scale="siko", line="rtu", computing_s=0.01, samples=2, haste=50.0)


@pytest.fixture
def plant(tmp_path: Path, request: pytest.FixtureRequest) -> Iterator[Plant]:
    site = getattr(request, "param", Site.instant())
    with prepared():
        plant = Plant(tmp_path / "home", [SPEC], Random(1), site)
        with plant.entered():
            assert plant.start(), plant.refusal
            yield plant
            plant.scheduler.end()


def ended(plant: Plant, run: int) -> str:
    """How a run ended."""
    assert plant.runtime is not None
    station = plant.runtime.orchestrator
    assert plant.scheduler.wait(lambda: station.running != run, 600.0)
    return plant.runtime.store.summary(run).state


def test_key_and_session_outlive_a_kill_and_a_revoked_key_does_not(plant: Plant) -> None:
    people = People(plant, Random(1))
    people.begin()
    run = people.mes.send("POST", "/calibrations", ORDER, key="job 1").run
    assert people.mes.send("GET", f"/calibrations/{run}").status == 200
    assert people.operator.send("GET", "/session").body["name"] == "Ada"
    cookie = people.operator.headers["Cookie"]
    plant.kill()
    with pytest.raises(NotRunning):
        people.mes.send("GET", "/station")
    assert plant.start(), plant.refusal
    assert people.mes.send("POST", "/calibrations", ORDER, key="job 1").run == run
    assert people.operator.send("GET", "/session").status == 200
    assert people.operator.headers["Cookie"] == cookie, "not signed in anew"
    people.renew_key()
    for _ in range(6):
        assert people.try_without_right(ORDER, passed=run).status in (401, 403)
    assert people.mes.send("GET", "/station").status == 200
    assert [event["n"] for event in people.pull()] == sorted({*range(1, people.pulled + 1)})
    assert people.pull() == []


def test_a_request_that_is_served_when_the_process_is_killed_is_never_answered(plant: Plant) -> None:
    people = People(plant, Random(1))
    people.begin()
    answers: list[object] = []

    def ask() -> None:
        with pytest.raises(NotRunning):
            answers.append(people.operator.send("POST", "/stop"))

    plant.disk.fail("locked", after=0, times=1_000_000)
    task = plant.scheduler.spawn(ask, "operator")
    plant.scheduler.give_way()
    plant.kill()
    plant.scheduler.wait(lambda: task.ended)
    assert answers == []


@pytest.mark.parametrize("plant", [SECOND], indirect=True, ids=["second family, RS-485, SIKO"])
def test_other_equipment_measures_and_stops(plant: Plant) -> None:
    people = People(plant, Random(1))
    people.begin()
    run = people.mes.send("POST", "/calibrations", ORDER).run
    assert ended(plant, run) == "succeeded"
    run = people.mes.send("POST", "/calibrations", ORDER).run
    plant.scheduler.wait(seconds=1.0)
    assert people.operator.send("POST", "/stop").body["confirmed"]
    assert ended(plant, run) == "aborted"
