"""A run carried out again from what crossed its wires: to the bit, or it says where it departed."""

from __future__ import annotations

import re
import sqlite3
import zlib
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest
from click.testing import CliRunner

from station.cli import main
from station.errors import InputRefused, NotFound
from station.motion import FaultOrder
from station.records import Reading, State
from station.service import Runtime, replay
from station.settings import EmulatedSettings, Settings
from station.store import Store
from tests.station.asking import asked

FAST = Settings(emulated=EmulatedSettings(speed=500.0))
EXAMPLE = Path(__file__).parents[3] / "docs" / "examples" / "recorded"
NOISE = (
    FaultOrder(device="scale", kind="twice", after_s=0.3, count=2),
    FaultOrder(device="scale", kind="bad_crc", after_s=0.5, count=1),
    FaultOrder(device="axis2", kind="exception", after_s=0.4, count=2),
    FaultOrder(device="axis1", kind="port_gone", after_s=0.6, count=1),
)


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """A run, one that uses its memory over a bad line, one that fails, one that is stopped."""
    folder = tmp_path_factory.mktemp("recorded")
    with Runtime.open(FAST, folder) as runtime:
        assert runtime.rig is not None
        states = [one(runtime)]
        runtime.rig.order(NOISE)
        states.append(one(runtime))
        runtime.rig.order([FaultOrder(device="axis1", kind="alarm", after_s=0.4)])
        states.append(one(runtime))
        runtime.rig.order([])
        stopped = runtime.orchestrator.submit(asked("R1", "full")).id
        runtime.orchestrator.abort(stopped)
        states.append(runtime.orchestrator.wait(stopped, 20))
    assert states == [State.SUCCEEDED, State.SUCCEEDED, State.FAILED, State.ABORTED]
    yield folder


def one(runtime: Runtime) -> State:
    return runtime.orchestrator.wait(runtime.orchestrator.submit(asked("R1", "rapid")).id, 60)


@pytest.fixture
def kept(home: Path) -> Iterator[Store]:
    with closing(Store(home / "station.db", read_only=True)) as store:
        yield store


def test_a_run_with_memory_over_a_bad_line_is_the_same_to_the_bit(kept: Store) -> None:
    used = kept.calibration(2).memory
    assert used is not None and used.from_calibration == 1
    found = replay(kept, 2)
    assert found.same, found
    assert found.of == len(kept.readings(2)) > 0


def test_a_run_that_failed_fails_with_the_same_words(kept: Store) -> None:
    assert kept.summary(3).reason
    assert replay(kept, 3).same


def test_a_run_that_was_stopped_is_refused(kept: Store) -> None:
    with pytest.raises(InputRefused, match="Run 4 was aborted"):
        replay(kept, 4)


def test_a_run_without_a_log_is_named(kept: Store) -> None:
    with pytest.raises(NotFound, match="no calibration 99"):
        replay(kept, 99)


def test_another_answer_gives_another_reading(home: Path, tmp_path: Path) -> None:
    """One sample of the last reading, by some micrometres."""
    with closing(Store(home / "station.db", read_only=True)) as store:
        store.backup(tmp_path / "station.db")
        lines = store.wire_log(1)
    values = [n for n, line in enumerate(lines) if re.search(" 1< 2[bd][0-9a-f]{28}0d0a$", line)]
    lines[values[-3]] = changed(lines[values[-3]])
    with closing(sqlite3.connect(tmp_path / "station.db")) as other, other:
        other.execute("DELETE FROM wire_logs WHERE run_id = 1 AND n > 1")
        whole = zlib.compress("".join(f"{line}\n" for line in lines).encode())
        other.execute("UPDATE wire_logs SET piece = ? WHERE run_id = 1", [whole])
    result = CliRunner().invoke(main, ["--home", str(tmp_path), "replay", "1"])
    assert result.exit_code == 1
    assert "The result differs" in result.output


def changed(line: str) -> str:
    head, _, data = line.rpartition(" ")
    value = bytearray.fromhex(data)
    at = value.index(b".") + 3
    value[at] = ord("0") + (value[at] - ord("0") + 1) % 10
    return f"{head} {value.hex()}"


def test_a_wire_log_in_words(home: Path) -> None:
    result = CliRunner().invoke(main, ["--home", str(home), "wire", "1"])
    assert result.exit_code == 0
    for said in (
        "scale  -> what is the value?",
        "servo  -> drive 1: read 0003h control mode",
        "servo  <- drive 1: 0003h control mode = 6 (0006h)",
        "servo  -> drive 2: write 6200h path 0",
    ):
        assert said in result.output


def test_a_crash_leaves_what_was_recorded_up_to_the_last_reading(home: Path, tmp_path: Path) -> None:
    with closing(Store(home / "station.db", read_only=True)) as store:
        store.backup(tmp_path / "station.db")
        whole = store.wire_log(1)
    with closing(sqlite3.connect(tmp_path / "station.db")) as other, other:
        other.execute("DELETE FROM wire_logs WHERE run_id = 1 AND n > 5")
    with closing(Store(tmp_path / "station.db")) as store:
        part = store.wire_log(1)
    assert 100 < len(part) < len(whole)
    assert part == whole[: len(part)]


def test_the_run_that_ships(tmp_path: Path) -> None:
    """Its readings, to the bit; the last bit of a result is that of the processor."""
    with closing(Store(EXAMPLE / "station.db", read_only=True)) as store:
        found = replay(store, 1)
        readings: list[Reading] = store.readings(1)
        made_by = store.made_by(1)
    assert made_by is not None, "it shows all that a run of today has"
    assert [device.driver for device in made_by.devices] == ["heidenhain-nd", *["leadshine-el7"] * 2]
    assert (found.departed, found.readings, found.of) == ("", len(readings), len(readings))
