"""The whole station on the emulated rig, in this process: opened, used, closed."""

from __future__ import annotations

from pathlib import Path

import pytest

from station.errors import InputRefused
from station.five_bar.robot_file import Robot
from station.motion.emulated_rig import EmulatedRig
from station.records import State
from station.service.runtime import Runtime
from station.settings import EmulatedSettings, ServiceSettings, Settings, load_settings
from station.store.store import Store
from tests.station.asking import asked

FAST = Settings(emulated=EmulatedSettings(speed=200.0))


def test_a_paper_run_on_the_emulated_rig_passes(tmp_path: Path) -> None:
    with Runtime.open(FAST, tmp_path) as runtime:
        run = runtime.orchestrator.submit(asked("R1", "paper")).id
        assert runtime.orchestrator.wait(run, 30) is State.SUCCEEDED
        calibration = runtime.store.calibration(run)
        assert calibration.verdict == "pass"
        assert len(runtime.store.readings(run)) == calibration.steps
        snapshot = runtime.orchestrator.snapshot()
        assert snapshot.station.emulated
        assert [device.state for device in snapshot.devices] == ["ok"] * 3


def test_a_paused_rig_is_stopped_over_its_real_wires(tmp_path: Path) -> None:
    slow = Settings(emulated=EmulatedSettings(speed=1.0))
    with Runtime.open(slow, tmp_path) as runtime:
        run = runtime.orchestrator.submit(asked("R1", "paper")).id
        assert runtime.orchestrator.wait(run, 1.0) is State.RUNNING
        runtime.orchestrator.stop("ada")
        assert runtime.orchestrator.wait(run, 5) is State.ABORTED
        assert runtime.store.calibration(run).reason == "Stopped by ada."


FAULTS = [
    ("scale_silent", 60, 1, ""),
    ("scale_garbled", 60, 1, ""),
    ("servo_link_dropped", 60, 1, ""),
    ("scale_fault_mark", 60, 1, "The linear scale marks its value as faulty"),
    ("drive_exception", 60, 1, " refuses the value"),
    ("drive_alarm", 3, 1, "shows alarm 180h on the way to"),
    ("drive_silent", 60, 60, " does not answer the gateway"),
]


@pytest.mark.parametrize(("kind", "after", "times", "reason"), FAULTS)
def test_a_fault_on_the_wire_is_survived_or_named(
    tmp_path: Path, kind: str, after: int, times: int, reason: str
) -> None:
    rig = tmp_path / "rig.toml"
    rig.write_text(f'[[fault]]\nkind = "{kind}"\nafter = {after}\ntimes = {times}\n')
    with Runtime.open(FAST, tmp_path, rig) as runtime:
        run = runtime.orchestrator.submit(asked("R1", "paper")).id
        state = runtime.orchestrator.wait(run, 30)
        calibration = runtime.store.calibration(run)
        if reason:
            assert (state, calibration.verdict) == (State.FAILED, None)
            assert reason in (calibration.reason or "")
            assert " position P" in (calibration.reason or "")
        elif kind == "servo_link_dropped" and state is State.FAILED:
            # a read is asked again, a move never: which of them the cable meets is a matter of timing
            assert " position P" in (calibration.reason or "")
            assert "axis" in (calibration.reason or "")
        else:
            assert state is State.SUCCEEDED


def test_what_a_crash_left_behind_is_interrupted_at_the_next_start(tmp_path: Path) -> None:
    store = Store(tmp_path / "station.db")
    run = store.create(asked("R1", "paper"), Robot.default("R1"))
    store.close()
    with Runtime.open(FAST, tmp_path) as runtime:
        assert runtime.store.calibration(run).state == "interrupted"
        last = runtime.orchestrator.snapshot().last
        assert last is not None and last.id == run


def test_one_process_holds_the_rig(tmp_path: Path) -> None:
    with Runtime.open(FAST, tmp_path), pytest.raises(InputRefused, match="holds the rig"):
        Runtime.open(FAST, tmp_path)
    Runtime.open(FAST, tmp_path).close()


def test_the_station_starts_without_its_devices_and_says_what_is_missing(tmp_path: Path) -> None:
    config = tmp_path / "station.toml"
    config.write_text(
        '[scale]\nprotocol = "heidenhain-nd"\nurl = "serial:///dev/no-such-port"\n'
        '[servo]\nprofile = "leadshine-el7"\nurl = "modbus+rtu:///dev/no-such-line"\n'
    )
    with Runtime.open(load_settings(config), tmp_path) as runtime:
        run = runtime.orchestrator.submit(asked("R1", "paper")).id
        assert runtime.orchestrator.wait(run, 10) is State.FAILED
        reason = runtime.store.calibration(run).reason or ""
        assert "/dev/no-such-port" in reason
        assert "/dev/no-such-line" in reason
        snapshot = runtime.orchestrator.snapshot()
        assert [device.state for device in snapshot.devices] == ["lost"] * 3
        assert not snapshot.interlocks[0].ok


def test_a_rig_that_does_not_start_is_refused_with_what_it_said(tmp_path: Path) -> None:
    bad = tmp_path / "rig.toml"
    bad.write_text("[machine]\nseed = 'x'\n")
    with pytest.raises(InputRefused, match=r"The emulated rig did not start: .*seed"):
        EmulatedRig(bad, tmp_path / "state.json", 50.0)
    with pytest.raises(InputRefused, match="did not start"):
        Runtime.open(FAST, tmp_path, tmp_path / "none.toml")


def test_a_folder_that_cannot_be_used_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(InputRefused, match="cannot be used"):
        Runtime.open(FAST, tmp_path / "file")


def test_a_history_that_is_gone_does_not_begin_anew_in_silence(tmp_path: Path) -> None:
    kept = tmp_path / "disk" / "kept.db"
    elsewhere = FAST.model_copy(update={"service": ServiceSettings(database=kept)})
    Runtime.open(elsewhere, tmp_path).close()
    kept.rename(tmp_path / "aside.db")
    with pytest.raises(InputRefused, match=rf"^The history {kept}, used here before, is gone: mount"):
        Runtime.open(elsewhere, tmp_path)
    assert not kept.exists()
    Runtime.open(FAST, tmp_path).close()  # another one may be used
    (tmp_path / "last-history").unlink()
    Runtime.open(elsewhere, tmp_path).close()
    assert kept.exists()
