"""Every fault at every step of a run, for every family of drives, readout and line, as one table.

`python -m tests.drivers.fault_matrix [--every N] [--rig SERVO,SCALE,LINE] [--workers N] [--own-times]
[--out FILE]`: the whole station on the emulated rig.  A cell states how the run ended and after how long; the
fault remains until then.  In each cell the drives must be at standstill, the readings must be stored, no
wrong result may pass, and the next run must succeed without a restart.

Most of the time of a cell is waiting for replies that do not come, so all cells are tried with shorter
time-outs; a sample with `--own-times` shows how long it takes on a real station.
"""

from __future__ import annotations

import argparse
import itertools
import json
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import AbstractContextManager, ExitStack
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from threading import Event
from unittest.mock import patch

from drivers.emulated.orders import KINDS
from station.motion import EmulatedRig, FaultOrder, Positioner, shift_of
from station.motion.machine import Machine
from station.records import State
from station.service import LiveEvent, Runtime
from station.settings import EmulatedSettings, LimitSettings, Settings
from tests.station.asking import asked

STEPS = ("connect", "enable", "move", "settle", "read", "compensate", "apply", "retract")
SERVOS, SCALES, LINES = ("leadshine-el7", "orientalmotor"), ("heidenhain-nd", "siko"), ("tcp", "rtu")
FAULTS = [
    *((device, kind) for device in ("scale", "axis1", "line") for kind in KINDS[device]),
    *(("inputs", kind) for kind in ("silent", "door_open", "temperature")),
]
DEG_PER_PULSE, SAVED_S, SAME_DEG = 360 / 200_000, 0.1, 0.02
SCALE_TIMEOUT_S, SERVO_TIMEOUT_S, STANDSTILL_LIMIT_S = 0.3, 0.1, 0.7
WATCHDOG_MS = 5000
TRUTH_DEG = (2.0, -1.0)
OUTSIDE_DEG = (-45.0, 140.0)
LIMIT_S = 180.0
SETTINGS = Settings(emulated=EmulatedSettings(speed=500.0), limits=LimitSettings(samples=2))


@dataclass(frozen=True)
class Cell:
    """The end of a run with a fault."""

    seconds: float
    state: State
    verdict: str | None
    reason: str
    wrong: str
    """The violation; empty if there is none."""

    @property
    def text(self) -> str:
        if self.wrong:
            return f"**{self.wrong}**"
        recovered = self.state is State.SUCCEEDED and self.verdict != "fail"
        return f"{'recovered' if recovered else 'named'} {self.seconds:.1f} s"


class Bench:
    """One station on one emulated rig, for any number of cells."""

    def __init__(
        self, devices: Sequence[str], folder: Path, stack: ExitStack, *, own_times: bool = False
    ) -> None:
        if not own_times:
            stack.enter_context(patch.object(EmulatedRig, "settings", _with_short_timeouts))
            stack.enter_context(patch("station.motion.machine.STANDSTILL_LIMIT_S", STANDSTILL_LIMIT_S))
        servo, scale, line = devices
        self._folder = folder
        rig = folder / "rig.toml"
        rig.write_text(
            f"[machine]\nzero_offsets_deg = {list(TRUTH_DEG)}\ndrm_mm = [1.0, 0.5]\n[emulated]\n"
            f'servo = "{servo}"\nscale = "{scale}"\nline = "{line}"\nbaud = 230400\n'
        )
        self.runtime = stack.enter_context(Runtime.open(SETTINGS, folder, rig))
        self.good = self._run("rapid")
        assert self.runtime.store.summary(self.good).verdict == "pass", self._reason(self.good)

    def cell(self, device: str, kind: str, step: str) -> Cell:
        """One fault at one step, and the run after it."""
        order = FaultOrder.model_validate({"device": device, "kind": kind})
        rig, ordered = self.runtime.rig, Event()
        assert rig is not None

        def now() -> None:
            if not ordered.is_set():
                ordered.set()
                rig.order([order])

        with ExitStack() as stack:
            began_s = time.monotonic()
            run = self._run_with(now, step, stack)
            seconds = time.monotonic() - began_s
        truth_deg = self._truth_deg()
        rig.order([])
        ended = self.runtime.store.summary(run)
        wrong = "" if ordered.is_set() else "the run did not come to this step"
        wrong = wrong or self._wrong(run, truth_deg) or self._next(applied=step == "apply")
        return Cell(seconds, ended.state, ended.verdict, ended.reason or "", wrong)

    def _run_with(self, now: Callable[[], None], step: str, stack: ExitStack) -> int:

        if step == "connect":
            now()
        elif step == "compensate":
            stack.callback(self.runtime.orchestrator.subscribe(_second_pass(now)))
        elif step != "retract":
            stack.enter_context(_before(_PLACES[step], now))
        if step == "retract":
            self._go_outside()
            stack.enter_context(_before(_PLACES[step], now))
            return self._ended(self.runtime.orchestrator.retract("ada").id)
        if step == "apply":
            return self._ended(self.runtime.orchestrator.follow("apply", self.good, "ada").id)
        return self._run("paper" if step == "compensate" else "rapid")

    def _run(self, plan: str) -> int:
        return self._ended(self.runtime.orchestrator.submit(asked("R1", plan)).id)

    def _ended(self, run: int) -> int:
        self.runtime.orchestrator.wait(run, LIMIT_S)
        return run

    def _go_outside(self) -> None:
        """Move the drives outside the workspace, without the station."""
        axes = self.runtime.orchestrator._machine.devices.axes
        for axis, angle in zip(axes, OUTSIDE_DEG, strict=True):
            axis.enable()
            axis.move_to(angle, 60.0)
        deadline_s = time.monotonic() + LIMIT_S
        while any(axis.status().moving for axis in axes) and time.monotonic() < deadline_s:
            time.sleep(0.01)

    def _truth_deg(self) -> tuple[float, float]:
        """True zero offsets in the drives' present frames, also after lost counts or power."""
        time.sleep(SAVED_S)
        zeros = json.loads((self._folder / "emulated-rig.json").read_text())["zero_pulses"]
        first, second = (zero * DEG_PER_PULSE for zero in zeros)
        return TRUTH_DEG[0] + first, TRUTH_DEG[1] + second

    def _wrong(self, run: int, truth_deg: tuple[float, float]) -> str:
        """The violation after the end of a run; empty if there is none."""
        store = self.runtime.store
        ended = store.calibration(run)
        if not ended.state.ended:
            return f"does not end within {LIMIT_S:.0f} s"
        if ended.state is not State.SUCCEEDED and not ended.reason:
            return "ended without a reason"
        if "Unexpected" in (ended.reason or ""):
            return f"an error in the program: {ended.reason}"
        if len(store.readings(run)) != ended.step:
            return f"{ended.step} steps, {len(store.readings(run))} readings"
        for zero, truth in zip(ended.zero_offsets, truth_deg, strict=False):
            if ended.verdict == "pass" and ended.kind == "calibrate":
                off = abs((zero.value_deg or 0.0) - truth)
                if off > 4.0 * (zero.sd_deg or 0.0) + 0.05:
                    return f"a pass with an error of {off:.3f} deg"
        return ""

    def _next(self, *, applied: bool) -> str:
        """The next runs: return into the workspace if needed, restored zeros, a check or calibration."""
        orchestrator = self.runtime.orchestrator
        deadline_s = time.monotonic() + LIMIT_S
        while not self._found() and time.monotonic() < deadline_s:
            pass
        shift = shift_of(self.runtime.store.zero_writes("R1", since=self.good))
        if max(map(abs, shift)) > SAME_DEG:
            run = self._ended(orchestrator.follow("rollback", self.good, "ada").id)
            if self.runtime.store.summary(run).state is not State.SUCCEEDED:
                return f"no rollback: {self._reason(run)}"
        if orchestrator.snapshot().retract.needed:
            run = self._ended(orchestrator.retract("ada").id)
            if self.runtime.store.summary(run).state is not State.SUCCEEDED:
                return f"no way back: {self._reason(run)}"
        if not applied:
            run = self._run("check")  # the shortest run
            if self.runtime.store.summary(run).verdict == "pass":
                return ""
        # Also after a check of a run during which a drive lost counts, which are restored now.
        run = self._run("rapid")  # `paper` need not converge with the step of a SIKO head
        if self.runtime.store.summary(run).verdict != "pass":
            return f"the next run: {self._reason(run)}"
        self.good = run  # zeros that were applied once are not applied again
        return ""

    def _found(self) -> bool:
        """Query the machine; returns whether all devices answer again, as they must without help."""
        orchestrator = self.runtime.orchestrator
        orchestrator.while_idle(lambda *_: orchestrator._machine.watch(), LIMIT_S)
        views = orchestrator.snapshot().devices
        return all(device.state == "ok" or "alarm" in device.text for device in views)

    def _reason(self, run: int) -> str:
        return self.runtime.store.summary(run).reason or ""


@dataclass(frozen=True)
class Place:
    """The beginning of a step: before the n-th call of a method."""

    owner: type
    method: str
    call: int = 1


_PLACES = {
    "enable": Place(Machine, "ready_axes"),
    "move": Place(Positioner, "_wait_in_position", 4),
    "settle": Place(Positioner, "_settled", 3),
    "read": Place(Positioner, "_sample", 6),
    "apply": Place(Positioner, "stand_at"),
    "retract": Place(Positioner, "go"),
}


def _before(place: Place, then: Callable[[], None]) -> AbstractContextManager[object]:
    """Call a function at a place."""
    original = getattr(place.owner, place.method)
    calls = itertools.count(1)

    def spied(self: object, *arguments: object, **more: object) -> object:
        if next(calls) == place.call:
            then()
        return original(self, *arguments, **more)

    return patch.object(place.owner, place.method, spied)


def _second_pass(then: Callable[[], None]) -> Callable[[LiveEvent], None]:
    sequences: list[object] = []

    def listen(event: LiveEvent) -> None:
        if event.type == "walk":
            sequences.append(event.data)
            if len(sequences) == 2:
                then()

    return listen


def _with_short_timeouts(rig: EmulatedRig, settings: Settings) -> Settings:
    found = _settings_of_rig(rig, settings)
    scale, servo = found.scale, found.servo
    assert scale is not None and servo is not None
    own = {"timeout_s": SERVO_TIMEOUT_S}
    if servo.profile == "orientalmotor":  # with several rigs at a time the computer is busy
        own["watchdog_ms"] = WATCHDOG_MS
    scale_options = scale.options.model_copy(update={"timeout_s": SCALE_TIMEOUT_S})
    return found.model_copy(
        update={
            "scale": scale.model_copy(update={"options": scale_options}),
            "servo": servo.model_copy(update={"options": servo.options.model_copy(update=own)}),
        }
    )


_settings_of_rig = EmulatedRig.settings


def cells(faults: Sequence[tuple[str, str]], steps: Sequence[str]) -> Iterator[tuple[tuple[str, str], str]]:
    """The existing cells: a fault of the scale does not affect a return that works without it."""
    yield from product(faults, steps)


@dataclass(frozen=True)
class Part:
    """The table of one rig."""

    lines: list[str]
    wrong: int
    longest_s: float
    cells: int


def part(number: int, rig: Sequence[str], every: int, own_times: bool) -> Part:
    """Try the cells of one rig; each result is written to standard error."""
    wrong, longest_s, tried = 0, 0.0, 0
    rows: dict[tuple[str, str], dict[str, str]] = {}
    with tempfile.TemporaryDirectory() as folder, ExitStack() as stack:
        bench = Bench(rig, Path(folder), stack, own_times=own_times)
        for count, (fault, step) in enumerate(cells(FAULTS, STEPS), start=number):
            if count % every:
                continue
            cell = bench.cell(*fault, step)
            print(*rig, *fault, step, cell.text, cell.reason, file=sys.stderr, flush=True)
            rows.setdefault(fault, {})[step] = cell.text
            wrong, longest_s, tried = wrong + bool(cell.wrong), max(longest_s, cell.seconds), tried + 1
    lines = ["", f"## {' · '.join(rig)}", f"| fault | {' | '.join(STEPS)} |", "|---" * 9 + "|"]
    lines += [
        f"| {' '.join(fault)} | {' | '.join(row.get(step, '') for step in STEPS)} |"
        for fault, row in rows.items()
    ]
    return Part(lines, wrong, longest_s, tried)


def main() -> int:
    """0, or 1 if there is a violation."""
    parser = argparse.ArgumentParser(prog="python -m tests.drivers.fault_matrix")
    parser.add_argument("--every", type=int, default=1, help="try only every N-th cell")
    parser.add_argument("--rig", help="try only this rig: SERVO,SCALE,LINE")
    parser.add_argument("--out", type=Path, help="file for the table; default: standard output")
    parser.add_argument("--workers", type=int, default=1, help="number of rigs tried at the same time")
    parser.add_argument("--own-times", action="store_true", help="use the time-outs of a real station")
    arguments = parser.parse_args()
    rigs = [tuple(arguments.rig.split(","))] if arguments.rig else list(product(SERVOS, SCALES, LINES))
    every = arguments.every
    with ProcessPoolExecutor(arguments.workers) as pool:
        tried = [pool.submit(part, n, rig, every, arguments.own_times) for n, rig in enumerate(rigs)]
        parts = [one.result() for one in tried]
    wrong, longest_s = sum(part.wrong for part in parts), max(part.longest_s for part in parts)
    count = sum(part.cells for part in parts)
    lines = [f"{count} cells; longest time to the end {longest_s:.1f} s; {wrong} cells with a violation."]
    text = "\n".join(lines + [line for part in parts for line in part.lines]) + "\n"
    if arguments.out:
        arguments.out.write_text(text, encoding="utf-8")
    else:
        print(text)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
