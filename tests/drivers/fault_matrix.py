"""Every fault at every step of a run, for every family of drives, readout and line, as one table.

`python -m tests.drivers.fault_matrix [--every N] [--rig SERVO,SCALE,LINE] [--out FILE]`: the whole station on
the emulated rig.  A cell says how the run ended and after how long; the fault stays until then.  In each, the
drives must stand, the readings be kept, no wrong result pass, and the next run succeed without a restart.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, ExitStack
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from unittest.mock import patch

from drivers.emulated.orders import KINDS
from station.motion import FaultOrder, Positioner
from station.motion.machine import Machine
from station.records import State
from station.service import LiveEvent, Runtime
from station.settings import EmulatedSettings, Settings
from tests.station.asking import asked

STEPS = ("connect", "enable", "move", "settle", "read", "compensate", "apply", "retract")
SERVOS, SCALES, LINES = ("leadshine-el7", "orientalmotor"), ("heidenhain-nd", "siko"), ("tcp", "rtu")
FAULTS = [(device, kind) for device in ("scale", "axis1", "line") for kind in KINDS[device]]
TRUTH_DEG = (2.0, -1.0)
OUTSIDE_DEG = (-45.0, 140.0)
LIMIT_S = 60.0
SETTINGS = Settings(emulated=EmulatedSettings(speed=500.0))


@dataclass(frozen=True)
class Cell:
    """How a run with a fault ended."""

    seconds: float
    state: State
    reason: str
    wrong: str
    """What must not be; empty where all is as it should."""

    @property
    def text(self) -> str:
        if self.wrong:
            return f"**{self.wrong}**"
        return f"{'recovered' if self.state is State.SUCCEEDED else 'named'} {self.seconds:.1f} s"


class Bench:
    """One station on one emulated rig, for as many cells as wanted."""

    def __init__(self, devices: Sequence[str], folder: Path, stack: ExitStack) -> None:
        servo, scale, line = devices
        rig = folder / "rig.toml"
        rig.write_text(
            f"[machine]\nzero_offsets_deg = {list(TRUTH_DEG)}\n[emulated]\n"
            f'servo = "{servo}"\nscale = "{scale}"\nline = "{line}"\nbaud = 230400\n'
        )
        self.runtime = stack.enter_context(Runtime.open(SETTINGS, folder, rig))
        self.good = self._run("rapid")
        assert self.runtime.store.summary(self.good).verdict == "pass", self._reason(self.good)

    def cell(self, device: str, kind: str, step: str) -> Cell:
        """One fault at one step, and the run after it."""
        order = FaultOrder.model_validate({"device": device, "kind": kind})
        with ExitStack() as stack:
            began_s = time.monotonic()
            run = self._run_with(order, step, stack)
            seconds = time.monotonic() - began_s
        assert self.runtime.rig is not None
        self.runtime.rig.order([])
        ended = self.runtime.store.summary(run)
        return Cell(seconds, ended.state, ended.reason or "", self._wrong(run) or self._next())

    def _run_with(self, order: FaultOrder, step: str, stack: ExitStack) -> int:
        rig = self.runtime.rig
        assert rig is not None
        done: list[bool] = []

        def now() -> None:
            if not done:
                done.append(True)
                rig.order([order])

        if step == "connect":
            now()
        elif step == "compensate":
            stack.callback(self.runtime.orchestrator.subscribe(_second_pass(now)))
        elif step in ("enable", "move", "settle", "read"):
            stack.enter_context(_before(*_PLACES[step], now))
        if step == "retract":
            self._go_outside()
            stack.enter_context(_before(Positioner, "go", now))
            return self._ended(self.runtime.orchestrator.retract("ada").id)
        if step == "apply":
            stack.enter_context(_before(Positioner, "stand_at", now))
            return self._ended(self.runtime.orchestrator.follow("apply", self.good, "ada").id)
        return self._run("paper")

    def _run(self, plan: str) -> int:
        return self._ended(self.runtime.orchestrator.submit(asked("R1", plan)).id)

    def _ended(self, run: int) -> int:
        self.runtime.orchestrator.wait(run, LIMIT_S)
        return run

    def _go_outside(self) -> None:
        """By hand, as it were: with the drives, past the station."""
        axes = self.runtime.orchestrator._machine.devices.axes
        for axis, angle in zip(axes, OUTSIDE_DEG, strict=True):
            axis.enable()
            axis.move_to(angle, 60.0)
        deadline_s = time.monotonic() + LIMIT_S
        while any(axis.status().moving for axis in axes) and time.monotonic() < deadline_s:
            time.sleep(0.01)

    def _wrong(self, run: int) -> str:
        """What must not be after the end of a run; empty where nothing is wrong."""
        store = self.runtime.store
        ended = store.calibration(run)
        if not ended.state.ended:
            return f"hangs for {LIMIT_S:.0f} s"
        if ended.state is not State.SUCCEEDED and not ended.reason:
            return "ended without a reason"
        if "Unexpected" in (ended.reason or ""):
            return f"a mistake of the program: {ended.reason}"
        if len(store.readings(run)) != ended.step:
            return f"{ended.step} steps, {len(store.readings(run))} readings"
        for zero, truth in zip(ended.zero_offsets, TRUTH_DEG, strict=False):
            if ended.verdict == "pass" and ended.kind == "calibrate":
                off = abs((zero.value_deg or 0.0) - truth)
                if off > 4.0 * (zero.sd_deg or 0.0) + 0.05:
                    return f"a pass that is {off:.3f} deg off"
        return ""

    def _next(self) -> str:
        """The next runs: back into the workspace where needed, zeros as they were, a calibration."""
        orchestrator = self.runtime.orchestrator
        application = self.runtime.store.zero_writes("R1", since=self.good)
        if application:
            run = self._ended(orchestrator.follow("rollback", self.good, "ada").id)
            if self.runtime.store.summary(run).state is not State.SUCCEEDED:
                return f"no rollback: {self._reason(run)}"
        time.sleep(0.6)  # the station looks at the machine twice a second
        if orchestrator.snapshot().retract.needed:
            run = self._ended(orchestrator.retract("ada").id)
            if self.runtime.store.summary(run).state is not State.SUCCEEDED:
                return f"no way back: {self._reason(run)}"
        run = self._run("rapid")  # `paper` need not converge with the step of a SIKO head
        if self.runtime.store.summary(run).verdict != "pass":
            return f"the next run: {self._reason(run)}"
        return ""

    def _reason(self, run: int) -> str:
        return self.runtime.store.summary(run).reason or ""


_PLACES: dict[str, tuple[type, str]] = {
    "enable": (Machine, "ready_axes"),
    "move": (Positioner, "stand_at"),
    "settle": (Positioner, "_pause"),
    "read": (Positioner, "_samples"),
}


def _before(owner: type, name: str, then: Callable[[], None]) -> AbstractContextManager[object]:
    """From its third call on, something happens before a method; at once for what is called but once."""
    original = getattr(owner, name)
    calls: list[int] = []

    def spied(self: object, *arguments: object, **more: object) -> object:
        calls.append(1)
        if name in ("ready_axes", "go") or len(calls) > 2:
            then()
        return original(self, *arguments, **more)

    return patch.object(owner, name, spied)


def _second_pass(then: Callable[[], None]) -> Callable[[LiveEvent], None]:
    sequences: list[object] = []

    def listen(event: LiveEvent) -> None:
        if event.type == "walk":
            sequences.append(event.data)
            if len(sequences) == 2:
                then()

    return listen


def cells(faults: Sequence[tuple[str, str]], steps: Sequence[str]) -> Iterator[tuple[tuple[str, str], str]]:
    """Which there are: a fault of the scale does not touch a way back that does without it."""
    yield from product(faults, steps)


def main() -> int:
    """0, or 1 where something is that must not be."""
    parser = argparse.ArgumentParser(prog="python -m tests.drivers.fault_matrix")
    parser.add_argument("--every", type=int, default=1, help="only every N-th cell")
    parser.add_argument("--rig", help="only this one, as SERVO,SCALE,LINE")
    parser.add_argument("--out", type=Path, help="where the table is written; else on standard output")
    arguments = parser.parse_args()
    rigs = [tuple(arguments.rig.split(","))] if arguments.rig else list(product(SERVOS, SCALES, LINES))
    lines, wrong, longest = [], 0, 0.0
    for number, rig in enumerate(rigs):
        lines += ["", f"## {' · '.join(rig)}", f"| fault | {' | '.join(STEPS)} |", "|---" * 9 + "|"]
        with tempfile.TemporaryDirectory() as folder, ExitStack() as stack:
            bench = Bench(rig, Path(folder), stack)
            rows: dict[tuple[str, str], dict[str, str]] = {}
            for count, (fault, step) in enumerate(cells(FAULTS, STEPS), start=number):
                if count % arguments.every:
                    continue
                cell = bench.cell(*fault, step)
                print(*rig, *fault, step, cell.text, cell.reason, file=sys.stderr, flush=True)
                rows.setdefault(fault, {})[step] = cell.text
                wrong, longest = wrong + bool(cell.wrong), max(longest, cell.seconds)
            lines += [
                f"| {' '.join(fault)} | {' | '.join(row.get(step, '') for step in STEPS)} |"
                for fault, row in rows.items()
            ]
    text = "\n".join([f"Longest end {longest:.1f} s; {wrong} cells are not as they should.", *lines]) + "\n"
    if arguments.out:
        arguments.out.write_text(text, encoding="utf-8")
    else:
        print(text)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
