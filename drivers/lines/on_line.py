"""The common base of all users of a line."""

from __future__ import annotations

from drivers.lines.serial import SerialLine


class OnLine:
    """A readout, a bus, or a drive on a bus."""

    def __init__(self, line: SerialLine) -> None:
        self._line = line

    @property
    def line(self) -> SerialLine:
        """The line, whose notice and opener are shared by all its users."""
        return self._line


def line_of(device: object) -> SerialLine | None:
    """The line of a device; None if it has none, as in tests without a wire."""
    return device.line if isinstance(device, OnLine) else None
