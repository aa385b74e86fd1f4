"""A drive that restarts while new zeros are verified: no zero is written from where it counts then.

Found by the simulation: the zero that was "put back" was 15 degrees away from the old one.
"""

from __future__ import annotations

from pathlib import Path
from random import Random

import pytest

from drivers.emulated.orders import FaultOrder
from drivers.emulated.spec import MachineSpec
from station.records import CalibrationRequest, State
from station.simulation.plant import Plant
from station.simulation.site import Site
from station.simulation.years import prepared

SPEC = MachineSpec(seed=3, zero_offsets_deg=(0.7, -0.4), drm_mm=(1.1, 0.4))
END_S = 600.0


def test_no_zero_is_written_from_where_a_restarted_drive_counts(tmp_path: Path) -> None:
    with prepared():
        plant = Plant(tmp_path / "home", [SPEC], Random(1), Site.instant())
        with plant.entered():
            assert plant.start(), plant.refusal
            _restart_in_verification(plant)
            plant.scheduler.end()


def _restart_in_verification(plant: Plant) -> None:
    assert plant.runtime is not None
    world, store, station = plant.scheduler, plant.runtime.store, plant.runtime.orchestrator
    run = plant.ask(lambda station: station.submit(CalibrationRequest("S", "calibrate", "ada", "rapid")).id)
    assert world.wait(lambda: station.running is None, END_S)
    applied = plant.ask(lambda station: station.follow("apply", run, "ada").id)
    assert world.wait(lambda: [write.taken for write in store.zero_writes("S")] == [True, True], END_S)
    world.wait(seconds=0.5)
    plant.orders.replace([FaultOrder(device="axis1", kind="reboot")])
    assert world.wait(lambda: station.running is None, END_S)
    plant.orders.replace(())
    world.wait(seconds=3.0)  # somebody homes it: it counts as before
    ended = store.summary(applied)
    assert ended.state is State.FAILED
    assert ended.reason is not None
    assert "way back failed" in ended.reason
    assert "old zero offsets are in the drives" not in ended.reason
    for joint, (axis, before) in enumerate(zip(plant.machine.axes, SPEC.zero_offsets_deg, strict=True), 1):
        told = sum(write.shift_deg or 0.0 for write in store.zero_writes("S") if write.joint == joint)
        assert axis.zero_offset_deg - before == pytest.approx(told, abs=0.01)
