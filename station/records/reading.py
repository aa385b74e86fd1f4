"""One reading in the store and in procedures."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Reading:
    """One row of contract.md's measurement file, and the raw samples of it."""

    reading: int
    """Unique within its calibration, from 1."""
    t_s: float
    theta_deg: tuple[float, ...]
    """Drive feedback, nominal frame, degrees (mean of the samples)."""
    approach: tuple[int, ...]
    scale_mm: float
    """Mean of the samples."""
    position: str
    sequence: int = 1
    samples_mm: tuple[float, ...] = ()
    temperature_c: float | None = None
    payload_kg: float | None = None
    mount: str | None = None
