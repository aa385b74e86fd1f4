"""The answer of a drive to its line."""

from __future__ import annotations

from dataclasses import dataclass

from drivers.emulated.orders import Kind as Kind


@dataclass(frozen=True, slots=True)
class DriveReply:
    """The answer of the drive; without a PDU: it was silent."""

    pdu: bytes | None
    delay_s: float = 0.0
    spoil: Kind | None = None
    """Disturbance of the frame during transmission."""


class DropLink(Exception):
    """An answer of a drive that makes a gateway close the connection."""


class HalfOpen(Exception):
    """An answer of a drive that makes a connection permanently silent without closing it."""
