"""The interface of all emulated readouts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol


@dataclass(frozen=True, slots=True)
class Reply:
    """Bytes to send, after a pause."""

    data: bytes
    delay_s: float = 0.0


class EmulatedReadout(Protocol):
    """It is independent of the transport: bytes come in, replies with their delay go out."""

    def receive(self, data: bytes) -> list[Reply]:
        """The answer to `data`."""
        ...

    def shift(self, by_mm: float) -> None:
        """Increase every value from now on, as after a miscount."""
        ...

    def reboot(self) -> None:
        """Simulate a power failure."""
        ...

    def is_value(self, data: bytes) -> bool:
        """Whether these bytes are a measured value."""
        ...

    def marked_faulty(self, data: bytes) -> bytes:
        """The output in place of a value that cannot be measured."""
        ...

    def in_other_unit(self, data: bytes) -> bytes:
        """The value in another unit, as after a change of the setting."""
        ...
