"""Globally unique identities, independent of the numbers of runs."""

from __future__ import annotations

import secrets
import time
import uuid


def uid7(at_ms: int | None = None) -> str:
    """UUID of version 7 (RFC 9562, section 5.7): milliseconds since 1970 (default: now), then random bits."""
    if at_ms is None:
        at_ms = time.time_ns() // 1_000_000
    bits = (at_ms % 2**48) << 80 | 0x7 << 76 | secrets.randbits(12) << 64 | 0b10 << 62 | secrets.randbits(62)
    return str(uuid.UUID(int=bits))
