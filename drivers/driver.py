"""The definition of a driver: its options in the station file, and a function that makes a device from them.

A further driver is one module with a `DRIVER` and one line in the register of its package
(docs/how-to/add-a-servo-drive.md).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Annotated, Generic, TypeVar

from pydantic import ConfigDict, Field

from drivers.lines import ModbusWords
from drivers.protocols import LinearScale, ServoAxis
from drivers.scaling import JointScaling
from drivers.strict_numbers import StrictNumbers

Seconds = Annotated[float, Field(gt=0, le=10)]


class DriverSettings(StrictNumbers):
    """Options of a driver in the station file.  Each driver adds its own; an unknown one is refused."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    url: str
    """Address of the line to which the device is connected."""


S = TypeVar("S", bound=DriverSettings)


@dataclass(frozen=True, slots=True)
class Drive:
    """One drive on a line, and the conversion of its pulses to a joint angle."""

    name: str
    unit: int
    scaling: JointScaling


@dataclass(frozen=True, slots=True)
class ScaleDriver(Generic[S]):
    """A readout that `[scale] protocol` can name."""

    settings: type[S]
    make: Callable[[S], LinearScale]
    """Make the readout; nothing is opened yet. :raises BadUrl:"""
    words: Callable[[bytes], str] = bytes.hex
    """The meaning of bytes sent or received on its line, for readers of a wire log."""


@dataclass(frozen=True, slots=True)
class ServoDriver(Generic[S]):
    """A family of drives that `[servo] profile` can name."""

    settings: type[S]
    make: Callable[[S, Sequence[Drive]], Sequence[ServoAxis]]
    """Make one axis per drive, in this order; nothing is opened yet. :raises BadUrl:"""
    registers: Mapping[int, str] = field(default_factory=dict)
    """Names by address, for readers of a wire log."""
    position_register: int | None = None
    """First of the two registers with the pulses of the joint's position."""

    def words(self, url: str) -> ModbusWords:
        """The meaning of frames on the line with this URL."""
        return ModbusWords(self.registers, over_tcp=url.startswith("modbus+tcp://"))
