"""Faults on order: at a moment, for a time or a number of occasions; from a rig file or while the rig runs.

`KINDS` lists the faults of each device. An order without `for_s` and `count` is active until it is withdrawn,
except for events (a jump, a reboot, ...), which happen once.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from threading import Lock
from typing import Annotated, Literal, Self

from pydantic import ConfigDict, Field, TypeAdapter, model_validator

from drivers.strict_numbers import StrictNumbers

Device = Literal["scale", "axis1", "axis2", "line", "inputs"]
Kind = Literal[
    "silent",
    "late",
    "wrong_id",
    "wrong_function",
    "bad_crc",
    "short",
    "garbage",
    "twice",
    "exception",
    "half_open",
    "port_gone",
    "echo",
    "alarm",
    "following_error",
    "never_in_position",
    "lost_counts",
    "contaminated",
    "overspeed",
    "frozen",
    "jump",
    "unit",
    "reboot",
    "door_open",
    "temperature",
]
_ON_ANY_WIRE: tuple[Kind, ...] = (
    "silent",
    "late",
    "bad_crc",
    "short",
    "garbage",
    "twice",
    "echo",
    "port_gone",
)
_ON_MODBUS: tuple[Kind, ...] = (*_ON_ANY_WIRE, "wrong_id", "wrong_function", "exception", "half_open")
_OF_A_DRIVE: tuple[Kind, ...] = (
    "alarm",
    "following_error",
    "never_in_position",
    "lost_counts",
    "frozen",
    "reboot",
)
KINDS: dict[Device, tuple[Kind, ...]] = {
    "scale": (
        *_ON_ANY_WIRE,
        *("contaminated", "overspeed", "frozen", "jump", "lost_counts", "unit", "reboot"),
    ),
    "axis1": (*_ON_MODBUS, *_OF_A_DRIVE),
    "axis2": (*_ON_MODBUS, *_OF_A_DRIVE),
    "line": _ON_MODBUS,
    "inputs": (*_ON_MODBUS, "door_open", "temperature"),
}
EVENTS: tuple[Kind, ...] = ("jump", "lost_counts", "reboot", "alarm", "following_error")
LATE_S = 1.5
"""Beyond the default time-out of every driver."""

Seconds = Annotated[float, Field(ge=0, le=86_400, allow_inf_nan=False)]


class FaultOrder(StrictNumbers):
    """One fault of an emulated device."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    device: Device
    """`line` is the Modbus line of both axes, `inputs` the module on it with guard door and thermometer."""
    kind: Kind
    after_s: Seconds = 0.0
    """Start, counted from the order."""
    for_s: Seconds | None = None
    """Duration; None: until it is withdrawn, or `count` is used up."""
    count: Annotated[int, Field(gt=0)] | None = None
    """Number of occasions (requests, motions) that it disturbs; None: all, or one for an event."""
    code: Annotated[int, Field(ge=0, le=0xFFFF)] = 0
    """Exception or alarm code; 0 selects a usual one."""
    mm: Annotated[float, Field(ge=-1000, le=1000, allow_inf_nan=False)] = 0.1
    """Size of a jump."""
    temperature_c: Annotated[float, Field(ge=-100, le=300, allow_inf_nan=False)] = 80.0
    """Temperature shown by the thermometer, degC, with `temperature`."""

    @model_validator(mode="after")
    def _device_can_have_it(self) -> Self:
        if self.kind not in KINDS[self.device]:
            raise ValueError(
                f"{self.device} cannot have {self.kind}; it can have {', '.join(KINDS[self.device])}"
            )
        return self


ORDERS: TypeAdapter[tuple[FaultOrder, ...]] = TypeAdapter(tuple[FaultOrder, ...])


class Orders:
    """The active orders; may be used from any thread."""

    def __init__(
        self, orders: Iterable[FaultOrder] = (), clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._lock = Lock()
        self._clock = clock
        self._given: tuple[FaultOrder, ...] = ()
        self._left: list[int | None] = []
        self._since_s = 0.0
        self.replace(orders)

    @property
    def given(self) -> tuple[FaultOrder, ...]:
        """The orders as received."""
        return self._given

    def replace(self, orders: Iterable[FaultOrder]) -> None:
        """Activate these and no others, counted from now."""
        with self._lock:
            self._given = tuple(orders)
            self._left = [1 if o.kind in EVENTS and o.count is None else o.count for o in self._given]
            self._since_s = self._clock()

    def hold(self, kinds: Iterable[Kind], *devices: Device) -> bool:
        """Whether one of these kinds is ordered for one of the devices, due or not."""
        with self._lock:
            return any(order.kind in kinds and order.device in devices for order in self._given)

    def due(self, kind: Kind, *devices: Device) -> FaultOrder | None:
        """Report an occasion for `kind`; returns the order that disturbs it, with one occasion used up."""
        if not self._given:
            return None
        with self._lock:
            passed_s = self._clock() - self._since_s
            for number, order in enumerate(self._given):
                if order.kind != kind or order.device not in devices or self._left[number] == 0:
                    continue
                if passed_s < order.after_s:
                    continue
                if order.for_s is not None and passed_s >= order.after_s + order.for_s:
                    continue
                left = self._left[number]
                self._left[number] = None if left is None else left - 1
                return order
        return None
