"""Readouts of the linear scale, one wire protocol a module."""

from __future__ import annotations

from drivers.scales.heidenhain_nd import HeidenhainND

__all__ = [
    "HeidenhainND",
]
