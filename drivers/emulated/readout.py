"""What every emulated readout can be told and asked."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol


@dataclass(frozen=True, slots=True)
class Reply:
    """Bytes to send, after a pause."""

    data: bytes
    delay_s: float = 0.0


class EmulatedReadout(Protocol):
    """It knows no transport: bytes come in, replies with their delay go out."""

    def receive(self, data: bytes) -> list[Reply]:
        """What it sends in answer to `data`."""
        ...

    def shift(self, by_mm: float) -> None:
        """Every value from now on is that much longer, as after a miscount."""
        ...

    def reboot(self) -> None:
        """As after a power cut."""
        ...

    def is_value(self, data: bytes) -> bool:
        """Whether these bytes are a measured value."""
        ...

    def marked_faulty(self, data: bytes) -> bytes:
        """What comes in place of a value that cannot be measured."""
        ...

    def in_other_unit(self, data: bytes) -> bytes:
        """The value as after somebody changed the unit."""
        ...
