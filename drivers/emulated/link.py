"""What a drive gives to the line that it is on."""

from __future__ import annotations

from dataclasses import dataclass

from drivers.emulated.orders import Kind as Kind


@dataclass(frozen=True, slots=True)
class DriveReply:
    """What came back from the drive; no PDU: it was silent."""

    pdu: bytes | None
    delay_s: float = 0.0
    spoil: Kind | None = None
    """What becomes of the frame on its way."""


class DropLink(Exception):
    """A drive's answer that makes a gateway close the connection."""


class HalfOpen(Exception):
    """A drive's answer that makes a connection dead without a word, for as long as it lives."""
