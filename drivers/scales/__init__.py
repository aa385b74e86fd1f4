"""Readouts of the linear scale, one wire protocol per module."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from drivers.driver import ScaleDriver
from drivers.scales import heidenhain_nd, siko
from drivers.scales.heidenhain_nd import HeidenhainND
from drivers.scales.siko import SikoHead

SCALES: Mapping[str, ScaleDriver[Any]] = {
    "heidenhain-nd": heidenhain_nd.DRIVER,
    "siko": siko.DRIVER,
}
"""Drivers by `[scale] protocol` of the station file."""

__all__ = [
    "SCALES",
    "HeidenhainND",
    "SikoHead",
]
