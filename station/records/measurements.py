"""Readings as arrays: the input of identification and diagnosis.

One row per reading, whatever the source: a file, a run in the store or a simulated sequence.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from station.records.reading import Reading
from station.records.scale_resolution import scale_resolution_mm
from station.records.types import Flags, Index, Real

Motion = Literal["step", "speed"]
"""From the previous reading, or through a reading."""
MOTIONS: tuple[Motion, ...] = get_args(Motion)


@dataclass(frozen=True)
class Measurements:
    """K readings of a machine with n joints; arrays share their first axis."""

    ids: tuple[int | str, ...]
    t_s: Real
    """(K,) seconds since start."""
    theta: Real
    """(K, n) joint angles from drive feedback, nominal frame, rad."""
    approach: NDArray[np.int8]
    """(K, n) sign of each joint's last motion, 0 unknown."""
    distance: Real
    """(K,) head reading or range, mm."""
    position: Index
    """(K,) index of the position; equal for repeats and other approaches of one position."""
    mount: Index
    """(K,) index into `mounts`."""
    samples: Index
    """(K,) number of samples of the head in the mean of each distance."""
    mounts: tuple[str, ...] = ("",)
    setup: Index | None = None
    """(K,) index into `setups`; None if machine and instrument were never moved."""
    setups: tuple[str, ...] = ("",)
    sliding: tuple[int, ...] = ()
    """Sliding joints, counted from 1; `theta` in metres: a metre and a radian move the end similarly."""
    resolution_mm: float = 0.0
    """Step of the readout if it is coarser than the noise of a sample, otherwise 0."""
    temperature_c: Real | None = None
    payload_kg: Real | None = None
    tracker: Real | None = None
    """(K, 2 or 3) independent position, mm."""
    guessed: tuple[str, ...] = ()
    """Data that were not recorded but inferred from the order of the rows: "approach", "position"."""
    came_from: Real | None = None
    """(K, n + 1) joint angles and distance of the previous reading, NaN before the first; computed if
    omitted, and retained by `take`, so that excluding a reading does not change another's history.
    """

    step: Real | None = None
    """(K, n) motion of each joint from the previous reading in time, 0 if unknown; of an arm's log, and
    retained by `take`, as is
    """
    speed: Real | None = None
    """(K, n) speed of each joint between the neighbouring readings, rad/s (rad per row without times)."""

    def __post_init__(self) -> None:
        if self.came_from is None:
            here = np.column_stack([self.theta, self.distance])
            before = np.vstack([np.full((1, here.shape[1]), np.nan), here[:-1]])
            object.__setattr__(self, "came_from", before)

    def __len__(self) -> int:
        return len(self.ids)

    @property
    def joints(self) -> int:
        return int(self.theta.shape[1])

    def take(self, rows: Flags | Index) -> Measurements:
        """The same measurements with only these rows (mask or indices)."""
        index = np.arange(len(self))[rows]
        taken: dict[str, Any] = {
            f.name: value[index]
            for f in fields(self)
            if isinstance(value := getattr(self, f.name), np.ndarray)
        }
        return replace(self, ids=tuple(self.ids[k] for k in index), **taken)

    def motion(self, kind: Motion) -> Real:
        """(K, n) step or speed; 0 if unknown."""
        known = self.step if kind == "step" else self.speed
        return np.zeros_like(self.theta) if known is None else known

    @property
    def numbers(self) -> Real:
        """(K,) numbers of the readings; 0 where they have names."""
        return np.array([i if isinstance(i, int) else 0 for i in self.ids], dtype=float)

    @property
    def setup_index(self) -> Index:
        """(K,) index into `setups`."""
        return np.zeros(len(self), dtype=np.intp) if self.setup is None else self.setup

    @cached_property
    def repeat_group(self) -> Index:
        """(K,) index of readings with one position, approach, mount and set-up: their scatter is pure
        error.
        """
        key = np.zeros(len(self), dtype=np.intp)
        for part in (self.position, *self.approach.T, self.mount, self.setup_index):
            least, most = (int(part.min()), int(part.max())) if len(self) else (0, 0)
            key = key * (most - least + 1) + (part - least)
        return np.unique(key, return_inverse=True)[1].reshape(-1)


def number(labels: Sequence[Hashable]) -> tuple[Index, tuple[Hashable, ...]]:
    """Labels as indices in order of first appearance, and the distinct labels."""
    order = {label: i for i, label in enumerate(dict.fromkeys(labels))}
    return np.array([order[label] for label in labels], dtype=np.intp), tuple(order)


def from_readings(readings: Sequence[Reading], mounts: Sequence[str] = ()) -> Measurements:
    """Arrays from the readings of one run in the orchestrator or the store.

    :param mounts: mounts of the readings that they belong to, if these may lack some
    """
    labels = [r.mount or "" for r in readings]
    # the robot file's own mounting point comes first, whenever it was measured
    mounts = tuple(dict.fromkeys([*mounts, *[label for label in labels if not label], *labels])) or ("",)
    mount = np.array([mounts.index(label) for label in labels], dtype=np.intp)

    def optional(values: list[float | None]) -> Real | None:
        return None if any(v is None for v in values) else np.array(values, dtype=float)

    return Measurements(
        ids=tuple(r.reading for r in readings),
        t_s=np.array([r.t_s for r in readings]),
        theta=np.radians([r.theta_deg for r in readings]),
        approach=np.array([r.approach for r in readings], dtype=np.int8),
        distance=np.array([r.scale_mm for r in readings]),
        position=number([r.position for r in readings])[0],
        mount=mount,
        samples=np.array([max(len(r.samples_mm), 1) for r in readings], dtype=np.intp),
        mounts=mounts,
        resolution_mm=scale_resolution_mm(sample for r in readings for sample in r.samples_mm),
        temperature_c=optional([r.temperature_c for r in readings]),
        payload_kg=optional([r.payload_kg for r in readings]),
    )
