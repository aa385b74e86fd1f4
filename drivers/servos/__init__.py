"""Servo drives, one family a module."""

from __future__ import annotations

from drivers.servos.leadshine_el7 import LeadshineEL7

__all__ = [
    "LeadshineEL7",
]
