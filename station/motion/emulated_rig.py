"""The only module that starts the emulated rig: a child process behind the same wires as a real one.

Its standard input stays open while it is needed; it ends by itself when that closes, even if the station is
killed.
"""

from __future__ import annotations

import json
import logging
import subprocess
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from queue import Empty, Queue
from threading import Lock, Thread
from typing import IO, Any

from pydantic import JsonValue

from drivers.emulated.orders import ORDERS
from drivers.emulated.orders import FaultOrder as FaultOrder
from station.errors import InputRefused
from station.interlock_settings import InterlockSettings
from station.settings import DEFAULT_JOINTS, ScaleSettings, ServoSettings, Settings

log = logging.getLogger(__name__)

_START_LIMIT_S = 20.0
_END_LIMIT_S = 3.0
_ORDER_LIMIT_S = 5.0


EffectTable = dict[str, JsonValue]
"""`kind` and the fields of that kind."""


class EmulatedRig:
    """A running emulated machine."""

    def __init__(self, rig: Path | None, state_file: Path, speed: float) -> None:
        """Start it and wait until its lines are up.

        :param rig: rig file; None is the one supplied
        :param state_file: file with its joint positions between two starts
        :param speed: its speed over real time
        :raises InputRefused: it did not start; the error contains its output.
        """
        self.speed = speed
        self.faults: tuple[FaultOrder, ...] = ()
        """Faults last ordered while it runs."""
        self.effects: tuple[EffectTable, ...] = ()
        """Effects last ordered; those of the rig file are not listed."""
        self._ordering = Lock()
        state_file.parent.mkdir(parents=True, exist_ok=True)
        command = [sys.executable, "-m", "drivers.emulated"]
        command += ["--state", str(state_file), "--speed", f"{speed:g}"]
        if rig is not None:
            command.append(str(rig))
        # A session of its own: Ctrl-C at the terminal must reach only the station, which then stops the
        # machine through its wires.
        self._process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )
        assert self._process.stdout is not None and self._process.stderr is not None
        self._complaints: list[str] = []
        self._lines: Queue[str] = Queue()
        self._readers = [
            Thread(target=_read, args=(self._process.stdout, self._lines.put), daemon=True),
            Thread(target=_read, args=(self._process.stderr, self._complain), daemon=True),
        ]
        for reader in self._readers:
            reader.start()
        try:
            told = json.loads(self._lines.get(timeout=_START_LIMIT_S))
            self._scale, self._servo = dict(told["scale"]), dict(told["servo"])
            self._interlocks = dict(told["interlocks"])
        except (Empty, json.JSONDecodeError, KeyError, TypeError) as error:
            self.close()
            said = self._complaints[-1] if self._complaints else "it did not say why"
            raise InputRefused(f"The emulated rig did not start: {said.rstrip('.')}.") from error

    def order(self, faults: Sequence[FaultOrder]) -> tuple[FaultOrder, ...]:
        """Activate these faults and no others; returns the active faults.

        :raises InputRefused: the rig does not accept them, or does not answer.
        """
        given = ORDERS.dump_python(tuple(faults), mode="json")
        self.faults = ORDERS.validate_python(self._order("faults", given))
        return self.faults

    def order_effects(self, effects: Sequence[EffectTable]) -> tuple[EffectTable, ...]:
        """Activate these imperfections of the machine and no others, as `[[effect]]` of a rig file.

        :raises InputRefused: as `order`.
        """
        self.effects = tuple(self._order("effects", list(effects)))
        return self.effects

    def remount(self, c: tuple[float, float], mounting: int = 0) -> None:
        """Mount the mechanism at c, mm; `mounting` numbers those at one point.

        :raises InputRefused: as `order`.
        """
        self._say("mount", [*c, mounting])

    def _order(self, what: str, tables: list[EffectTable]) -> list[EffectTable]:
        ordered: list[EffectTable] = self._say(what, tables)
        return ordered

    def _say(self, what: str, content: Sequence[object]) -> Any:
        assert self._process.stdin is not None
        with self._ordering:
            try:
                self._process.stdin.write(json.dumps({what: content}) + "\n")
                self._process.stdin.flush()
                answer = json.loads(self._lines.get(timeout=_ORDER_LIMIT_S))
            except (OSError, Empty, json.JSONDecodeError) as error:
                raise InputRefused("The emulated rig does not answer; start the station again.") from error
        if "error" in answer:
            raise InputRefused(f"The emulated rig refuses the {what}: {answer['error']}.")
        return answer[what]

    def settings(self, settings: Settings) -> Settings:
        """The station's settings with its devices at this rig's addresses, and the rig's door and thermometer
        unless the station file defines others.
        """
        declared = settings.interlocks.model_dump(exclude_none=True)
        joints = settings.servo.joint if settings.servo else DEFAULT_JOINTS
        return settings.model_copy(
            update={
                "scale": ScaleSettings.model_validate(self._scale),
                "servo": ServoSettings.model_validate({**self._servo, "joint": joints}),
                "interlocks": InterlockSettings.model_validate({**self._interlocks, **declared}),
            }
        )

    def close(self) -> None:
        """End it; repeating it is harmless."""
        assert self._process.stdin is not None
        self._process.stdin.close()
        try:
            self._process.wait(_END_LIMIT_S)
        except subprocess.TimeoutExpired:
            log.warning("The emulated rig does not end by itself and is killed")
            self._process.kill()
            self._process.wait()
        for reader in self._readers:
            reader.join()

    def _complain(self, line: str) -> None:
        if line:
            self._complaints.append(line)
            log.info("emulated rig: %s", line)


def _read(stream: IO[str], take: Callable[[str], None]) -> None:
    with stream:
        for line in stream:
            take(line.strip())
    take("")  # the end of the output, so that nobody waits for a line that will not come
