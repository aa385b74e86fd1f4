"""kill -9 at any moment: every stored reading is there afterwards, and the run is `interrupted`."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from station.store.store import Store

CHILD = """
import sys
from pathlib import Path
from station.service import Orchestrator
from station.records import CalibrationRequest
from station.store import Store
from tests.station.asking import asked, kinds_with
from tests.station.conftest import SETTINGS
from tests.station.fakes import make_rig, two_sequences

moment, rig = sys.argv[2], make_rig()

def wait():
    print("here", flush=True)
    sys.stdin.read()

call, at = moment.split(":")
rig.script.do(call, wait, at=int(at))
store = Store(Path(sys.argv[1]))
store.interrupt_unfinished()
orchestrator = Orchestrator(rig.devices, store, SETTINGS, kinds_with(two_sequences))
orchestrator.submit(asked("R1", "paper"), idempotency_key="k")
sys.stdin.read()
"""

MOMENTS = [
    ("axis 1 connect:1", 0),
    ("axis 1 move_to:1", 0),
    ("scale read:3", 0),
    ("axis 2 move_to:2", 1),
    ("scale read:7", 2),
    ("axis 1 move_to:10", 5),
]


@pytest.mark.parametrize(("moment", "readings"), MOMENTS)
def test_what_was_measured_before_a_kill_is_kept(tmp_path: Path, moment: str, readings: int) -> None:
    path = tmp_path / "station.db"
    with subprocess.Popen(
        [sys.executable, "-c", CHILD, str(path), moment], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as child:
        assert child.stdout is not None
        assert child.stdout.readline() == b"here\n"
        os.kill(child.pid, signal.SIGKILL)
        child.wait(10)
    store = Store(path)
    try:
        assert [r.reading for r in store.readings(1)] == list(range(1, readings + 1))
        assert store.calibration(1).step == readings
        assert store.interrupt_unfinished() == [1]
        calibration = store.calibration(1)
        assert (calibration.state, calibration.verdict) == ("interrupted", None)
        assert calibration.ended_at is not None
    finally:
        store.close()
