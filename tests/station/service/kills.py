"""Kills and freezes the station at random instants of motion, and checks that the machine is not harmed.

`python -m tests.station.service.kills [--kills N] [--freezes N] [--servo FAMILY] [--seed S] [--workers N]`:
each rig runs in a separate process group. After each: the drives come to standstill, within 350 ms if the
drive has a communication watchdog (300 ms and the 50 ms between two queries of the machine), otherwise after
the active motion; the arm is brought back if necessary; and the next run, a check, passes.
"""

from __future__ import annotations

import argparse
import json
import random
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from station.records import State
from station.service import Runtime
from station.settings import DEFAULT_JOINTS, Settings
from tests.station.asking import asked

SPEED = 1.0
WATCHDOG_S, LOOK_S = 0.3, 0.05
LONGEST_MOVE_S = 4.0
STANDS_S = 0.4
END_S = 60.0
_RUN = ("--plan", "rapid", "--serial", "R1", "--operator", "ada")


def command(module: str, *arguments: object) -> list[str]:
    """A program of the repository, by this interpreter."""
    return [sys.executable, "-m", module, *map(str, arguments)]


@dataclass(frozen=True)
class Blow:
    """One kill or freeze, and its result."""

    signal: str
    stood_s: float
    """From the signal to the last motion; 0 where nothing moved."""
    wrong: str
    """Empty if all requirements are met."""


class Victim:
    """A separate rig, and stations that are killed on it."""

    def __init__(self, folder: Path, servo: str) -> None:
        self.folder, self.servo = folder, servo
        self._state = folder / "rig-state.json"
        rig = folder / "rig.toml"
        machine = "[machine]\nzero_offsets_deg = [1.0, -0.5]\ndrm_mm = [1.0, 0.5]\n"
        rig.write_text(f'{machine}[emulated]\nservo = "{servo}"\n')
        self._rig = subprocess.Popen(
            command("drivers.emulated", rig, "--state", self._state, "--speed", SPEED),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )
        assert self._rig.stdout is not None
        self.devices: dict[str, dict[str, Any]] = json.loads(self._rig.stdout.readline())
        self._config = folder / "station.toml"
        self._config.write_text(_toml(self.devices))
        assert not (trouble := self._run("rapid")), trouble

    def close(self) -> None:
        assert self._rig.stdin is not None and self._rig.stdout is not None
        self._rig.stdin.close()
        self._rig.wait()
        self._rig.stdout.close()

    def blow(self, number: signal.Signals, after_s: float) -> Blow:
        """Start a run, hit it this long after its first motion, check, bring back, run again."""
        station = subprocess.Popen(
            command("station", "--home", self.folder, "calibrate", "--config", self._config, *_RUN),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
        self._wait_for_motion(station)
        time.sleep(after_s)
        station.send_signal(number)
        stood_s = self._last_motion_s(time.monotonic())
        if number is signal.SIGSTOP:
            station.send_signal(signal.SIGCONT)
            station.send_signal(signal.SIGINT)  # without a watchdog it would continue to measure
        station.wait(END_S)
        limit_s = WATCHDOG_S + LOOK_S if self.servo == "orientalmotor" else LONGEST_MOVE_S
        wrong = f"moved for {stood_s:.2f} s" if stood_s > limit_s else self._again()
        return Blow(number.name, stood_s, wrong)

    def _wait_for_motion(self, station: subprocess.Popen[bytes]) -> None:
        before = self._state.read_text()
        deadline_s = time.monotonic() + END_S
        while self._state.read_text() == before and time.monotonic() < deadline_s:
            assert station.poll() is None, "the run ended before anything moved"
            time.sleep(0.01)

    def _last_motion_s(self, since_s: float) -> float:
        last, changed_s = self._state.read_text(), since_s
        while time.monotonic() < changed_s + STANDS_S:
            time.sleep(0.005)
            if (now := self._state.read_text()) != last:
                last, changed_s = now, time.monotonic()
        return changed_s - since_s

    def _again(self) -> str:
        return self._run("check")

    def _run(self, plan: str) -> str:
        """Bring the arm back if necessary, and run; returns the fault, or empty."""
        settings = Settings.model_validate(
            {
                **self.devices,
                "servo": {**self.devices["servo"], "joint": DEFAULT_JOINTS},
                "limits": {"speed_deg_s": 120.0, "settle_s": 0.0, "samples": 2},
            }
        )
        with Runtime.open(settings, self.folder) as runtime:
            while runtime.orchestrator.snapshot().machine is None:
                time.sleep(0.05)  # it queries the machine twice a second
            if runtime.orchestrator.snapshot().retract.needed:
                run = runtime.orchestrator.retract("ada").id
                runtime.orchestrator.wait(run, END_S)
                if runtime.store.summary(run).state is not State.SUCCEEDED:
                    return f"no way back: {runtime.store.summary(run).reason}"
            run = runtime.orchestrator.submit(asked("R1", plan)).id
            runtime.orchestrator.wait(run, END_S)
            ended = runtime.store.summary(run)
            return "" if ended.verdict == "pass" else f"the next run: {ended.reason}"


@contextmanager
def victim(servo: str) -> Iterator[Victim]:
    """A rig in a separate folder."""
    with tempfile.TemporaryDirectory() as folder:
        one = Victim(Path(folder), servo)
        try:
            yield one
        finally:
            one.close()


def _toml(devices: Mapping[str, Mapping[str, Any]]) -> str:
    lines = []
    tables = {name: options for name, options in devices.items() if name != "interlocks"}
    tables |= {f"interlocks.{name}": options for name, options in devices["interlocks"].items()}
    for section, options in tables.items():
        lines += [f"[{section}]", *(f"{key} = {json.dumps(value)}" for key, value in options.items())]
    for joint in DEFAULT_JOINTS:
        lines += ["[[servo.joint]]", f"unit = {joint.unit}", f"zero_at_deg = {joint.zero_at_deg}"]
    return "\n".join(lines) + "\n"


def blows_of(servo: str, signals: Sequence[signal.Signals], seed: int) -> list[Blow]:
    """One rig, and a station on it that is hit this many times."""
    rng = random.Random(seed)
    blows = []
    with victim(servo) as one:
        for number in signals:
            blows.append(one.blow(number, rng.uniform(0.0, 4.0)))
            print(blows[-1], flush=True)
    return blows


def main() -> int:
    """0, or 1 if a requirement is violated."""
    parser = argparse.ArgumentParser(prog="python -m tests.station.service.kills")
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--freezes", type=int, default=100)
    parser.add_argument("--servo", default="orientalmotor")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--workers", type=int, default=1, help="stations at the same time")
    arguments = parser.parse_args()
    signals = [signal.SIGKILL] * arguments.kills + [signal.SIGSTOP] * arguments.freezes
    shares = [signals[number :: arguments.workers] for number in range(arguments.workers)]
    with ProcessPoolExecutor(arguments.workers) as pool:
        seeds = range(arguments.seed, arguments.seed + arguments.workers)
        hit = pool.map(blows_of, [arguments.servo] * arguments.workers, shares, seeds)
        blows = [blow for share in hit for blow in share]
    wrong = [blow for blow in blows if blow.wrong]
    longest_s = max((blow.stood_s for blow in blows), default=0.0)
    print(f"{arguments.servo}: {len(blows)}, longest motion after it {longest_s:.2f} s, {len(wrong)} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
