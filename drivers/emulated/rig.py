"""The emulated rig: scale on a pseudo-terminal, drives behind a Modbus TCP gateway, one machine."""

from __future__ import annotations

import json
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from threading import Event, Thread
from types import TracebackType
from typing import Self

from drivers.emulated.blvr import BLVRDrive
from drivers.emulated.drive import EmulatedDrive
from drivers.emulated.el7 import CS2RS, EL7, EL7Drive
from drivers.emulated.faults import Faults
from drivers.emulated.input_module import INPUTS, TEMPERATURE, UNIT, InputModule
from drivers.emulated.link import DriveReply, DropLink
from drivers.emulated.machine import Machine, MachineState
from drivers.emulated.modbus_rtu import RtuLine
from drivers.emulated.modbus_tcp import ModbusTcpGateway
from drivers.emulated.nd280 import ND280
from drivers.emulated.orders import Orders
from drivers.emulated.pty_line import PtyLine
from drivers.emulated.readout import EmulatedReadout
from drivers.emulated.siko_head import SikoDevice
from drivers.emulated.spec import Fault, RigSpec
from drivers.emulated.spoiled import ReadoutOnLine, SpoiledDrive, SpoiledInputs

Answer = Callable[[bytes], DriveReply]
"""Answer of a unit on the line to a request PDU."""
_SAVE_EVERY_S = 0.05
_SCALE_LINES = {"heidenhain-nd": "baud=9600&format=7E2&override=8N1", "siko": "baud=19200&format=8N1"}


class EmulatedRig:
    """A context manager; inside it the devices answer at `scale_url` and `servo_url`.

    Drive addresses are 1 and 2.  With a state file the drives start in their last positions, even after the
    process was killed.
    """

    def __init__(self, spec: RigSpec, *, speed: float | None = None, state_file: Path | None = None) -> None:
        """:param speed: overrides the spec's; :param state_file: likewise"""
        self.spec = spec
        self.machine = Machine(spec.machine, speed=speed or spec.emulated.speed)
        self._faults = Faults(spec.faults)
        self.orders = Orders(spec.orders)
        self._state_file = state_file
        if state_file is None and spec.emulated.state_file is not None:
            self._state_file = Path(spec.emulated.state_file)
        self._open = ExitStack()
        self.scale_url = ""
        self.servo_url = ""

    def __enter__(self) -> Self:
        with ExitStack() as stack:
            if self._state_file is not None:
                stack.enter_context(_StateKeeper(self.machine, self._state_file))
            line = PtyLine(ReadoutOnLine(self._readout(), self.orders).receive, self._flow_control)
            stack.callback(line.close)
            self.scale_url = f"serial://{line.port}?{_SCALE_LINES[self.spec.emulated.scale]}"
            drives = {joint: self._drive(joint) for joint in (1, 2)}
            for drive in drives.values():
                stack.callback(drive.close)
            behind_gateway = self.spec.emulated.line == "tcp"
            units: dict[int, Answer] = {
                joint: _DriveOnLine(
                    SpoiledDrive(drive, joint, self.orders, behind_gateway=behind_gateway),
                    joint,
                    self._faults,
                )
                for joint, drive in drives.items()
            }
            inputs = InputModule(self.machine)
            units[UNIT] = SpoiledInputs(inputs, self.orders, behind_gateway=behind_gateway).answer
            self.servo_url = self._connect(units, drives[1].check_sum_exception, stack)
            self._open = stack.pop_all()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._open.close()

    def inject(self, fault: Fault) -> None:
        """Add a wire fault, counted from now."""
        self._faults.add(fault)

    def clear_faults(self) -> None:
        """No more faults."""
        self._faults.clear()

    @property
    def scale_options(self) -> dict[str, str | float]:
        """`[scale]` of a station file for this rig."""
        options: dict[str, str | float] = {"protocol": self.spec.emulated.scale, "url": self.scale_url}
        if self.spec.emulated.scale == "siko":
            options["resolution_mm"] = self.spec.emulated.scale_resolution_mm
        return options

    @property
    def servo_options(self) -> dict[str, str]:
        """`[servo]` of a station file for this rig, without its joints."""
        return {"profile": self.spec.emulated.servo, "url": self.servo_url}

    @property
    def _flow_control(self) -> bool:
        return self.spec.emulated.scale == "heidenhain-nd"

    def _readout(self) -> EmulatedReadout:
        if self.spec.emulated.scale == "siko":
            return SikoDevice(self.machine.head_mm, self._faults, self.spec.emulated.scale_resolution_mm)
        return ND280(self.machine.head_mm, self._faults)

    def _drive(self, joint: int) -> EmulatedDrive:
        family = self.spec.emulated.servo
        if family == "orientalmotor":
            return BLVRDrive(self.machine, joint, self._faults, self.spec.machine.counts_per_rev)
        return EL7Drive(self.machine, joint, self._faults, CS2RS if family == "leadshine-cs2rs" else EL7)

    @property
    def interlock_options(self) -> dict[str, dict[str, float]]:
        """`[interlocks]` of a station file for this rig: the connections of guard door and thermometer."""
        return {
            "guard_door": {"unit": UNIT, "address": INPUTS, "bit": 0},
            "temperature": {
                "unit": UNIT,
                "address": TEMPERATURE,
                "factor_c": 0.1,
                "low_c": 0.0,
                "high_c": 60.0,
            },
        }

    def _connect(self, units: dict[int, Answer], check_sum_exception: int | None, stack: ExitStack) -> str:
        """Connect the drives to their line; returns its address."""
        if self.spec.emulated.line == "tcp":
            gateway = ModbusTcpGateway(units)
            stack.callback(gateway.close)
            return f"modbus+tcp://127.0.0.1:{gateway.port}"
        baud = self.spec.emulated.baud
        line = RtuLine(units, baud=baud, check_sum_exception=check_sum_exception)
        stack.callback(line.close)
        return f"modbus+rtu://{line.port}?baud={baud}&format=8N2"


class _DriveOnLine:
    """A drive with the faults of the line in front of it."""

    def __init__(self, drive: SpoiledDrive, joint: int, faults: Faults) -> None:
        self._drive = drive
        self._joint = joint
        self._faults = faults

    def __call__(self, request: bytes) -> DriveReply:
        if self._faults.due("servo_link_dropped", self._joint):
            raise DropLink
        if self._faults.due("drive_silent", self._joint):
            return DriveReply(None)
        late = self._faults.due("drive_late", self._joint)
        reply = self._drive.answer(request)
        return replace(reply, delay_s=late.delay_s) if late else reply


class _StateKeeper:
    """Stores the machine's position in a file, so that it survives a kill."""

    def __init__(self, machine: Machine, path: Path) -> None:
        self._machine = machine
        self._path = path
        self._closing = Event()
        self._saved: MachineState | None = None
        self._thread = Thread(target=self._keep, name="emulated machine's state")

    def __enter__(self) -> Self:
        if self._path.exists():
            self._machine.restore(_load_state(self._path))
        try:
            self._save()
        except OSError as error:
            raise StateFileError(
                f"The state file {self._path} cannot be written: {error.strerror}."
            ) from error
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._closing.set()
        self._thread.join()

    def _keep(self) -> None:
        while not self._closing.wait(_SAVE_EVERY_S):
            self._save()
        self._save()

    def _save(self) -> None:
        state = self._machine.state()
        if state == self._saved:
            return
        draft = self._path.with_name(self._path.name + ".new")
        draft.write_text(json.dumps({"shaft_pulses": state.shaft_pulses, "zero_pulses": state.zero_pulses}))
        draft.replace(self._path)  # atomic replacement
        self._saved = state


class StateFileError(ValueError):
    """A state file is unusable; the text is one sentence."""


def _load_state(path: Path) -> MachineState:
    try:
        table = json.loads(path.read_text(encoding="utf-8"))
        first, second = (float(pulses) for pulses in table["shaft_pulses"])
        zero_first, zero_second = (int(pulses) for pulses in table["zero_pulses"])
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise StateFileError(f"The state file {path} is damaged; delete it to start at the zeros.") from error
    return MachineState((first, second), (zero_first, zero_second))
