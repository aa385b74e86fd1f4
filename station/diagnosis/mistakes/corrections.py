"""Changes of a file that undo one mistake each: of the readings, the angles, or the order of the rows."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.diagnosis.mistakes.mistake import Kind
from station.five_bar import Robot
from station.records import Measurements, Real

SCALE_UNITS = {
    "inches": 25.4, "metres": 1e3, "micrometres": 1e-3, "centimetres": 10.0, "tenths of a millimetre": 0.1,
    "thousandths of an inch": 0.0254, "feet": 304.8, "nanometres": 1e-6,
}  # fmt: skip
SCALE_FACTORS = {
    "twice": 0.5, "half": 2.0, "four times": 0.25, "a quarter of": 4.0, "five times": 0.2, "a fifth of": 5.0,
}  # fmt: skip
"""How much too large the readings are (wrong interpolation or counting of edges), and the correction."""
ANGLE_UNITS = {
    "radians": 180.0 / np.pi, "minutes of arc": 1.0 / 60.0, "seconds of arc": 1.0 / 3600.0,
    "milliradians": 0.18 / np.pi, "gon": 0.9, "turns": 360.0, "tenths of a degree": 0.1,
    "thousandths of a degree": 1e-3,
}  # fmt: skip
SHIFTS = (1, -1, 2, -2, 3, -3)
BOTH: tuple[tuple[int, ...], ...] = ((0,), (1,), (0, 1))
AT_MOST_ONE: tuple[tuple[int, ...], ...] = ((), (0,), (1,))


@dataclass(frozen=True)
class Correction:
    """One way to put a file right."""

    kind: Kind
    what: str
    """What is wrong, as the end of "... looks as if": a full clause."""
    action: str
    """What to do, an imperative clause."""
    column: str
    apply: Callable[[Measurements], tuple[Measurements, NDArray[np.bool_]]]
    """The corrected file, and the rows that still have all they need."""


def joint_names(joints: tuple[int, ...]) -> str:
    """In words."""
    return "joint 1 and joint 2" if len(joints) == 2 else f"joint {joints[0] + 1}"


def columns_of(joints: tuple[int, ...]) -> str:
    """Names of the angle columns."""
    return " and ".join(f"theta{i + 1}_deg" for i in joints)


def corrections(robot: Robot) -> Iterator[Correction]:
    """Every one that needs no number found first."""
    yield Correction(
        "scale_sign", "scale_mm counts backwards", "reverse the sign of scale_mm", "scale_mm", _scaled(-1.0)
    )
    for unit, factor in SCALE_UNITS.items():
        yield Correction(
            "scale_unit",
            f"scale_mm is in {unit}",
            f"multiply scale_mm by {factor:g}",
            "scale_mm",
            _scaled(factor),
        )
    for share, factor in SCALE_FACTORS.items():
        yield Correction(
            "scale_factor", f"scale_mm is {share} the travel", f"multiply scale_mm by {factor:g}", "scale_mm",
            _scaled(factor),
        )  # fmt: skip
    for unit, factor in ANGLE_UNITS.items():
        for joints in BOTH:
            yield Correction(
                "angle_unit", f"{columns_of(joints)} is in {unit}", f"multiply it by {factor:g}",
                columns_of(joints), _turned(joints, factor, (0.0, 0.0)),
            )  # fmt: skip
    for joints in BOTH:
        yield Correction(
            "joint_sign", f"{joint_names(joints)} counts the other way round",
            "reverse its sign in [joints] or in the file", columns_of(joints),
            _turned(joints, -1.0, robot.zero_at_deg),
        )  # fmt: skip
        if any(robot.zero_at_deg[i] % 180.0 for i in joints):
            yield Correction(
                "joint_sign", f"{columns_of(joints)} has the wrong sign", "reverse it", columns_of(joints),
                _turned(joints, -1.0, (0.0, 0.0)),
            )  # fmt: skip
    yield Correction(
        "joints_exchanged", "theta1_deg and theta2_deg are exchanged", "exchange the two columns",
        "theta1_deg and theta2_deg", _exchanged,
    )  # fmt: skip
    yield Correction(
        "joints_exchanged", "the joints are numbered from the other side", "exchange the joints",
        "theta1_deg and theta2_deg", _mirrored,
    )  # fmt: skip
    for by in SHIFTS:
        rows = "one row" if abs(by) == 1 else f"{abs(by)} rows"
        way = "late" if by > 0 else "early"
        for joints in AT_MOST_ONE:
            column = columns_of(joints) if joints else "scale_mm"
            beside = "" if joints else ", or both angle columns the other way"
            yield Correction(
                "row_shift", f"{column} stands {rows} too {way}{beside}",
                f"move the column {'up' if by > 0 else 'down'} by {rows}", column, _shifted(joints, by),
            )  # fmt: skip


def scaled_angles(joints: tuple[int, ...], factor: float, about_deg: tuple[float, float]) -> Correction:
    """A ratio in [joints] that is wrong by the reciprocal of a factor."""
    return Correction(
        "ratio", f"[joints] ratio or counts_per_rev of {joint_names(joints)} is wrong by a factor of "
        f"{factor:.5g}",
        f"divide the ratio by {factor:.5g} and read the angles again", columns_of(joints),
        _turned(joints, factor, about_deg),
    )  # fmt: skip


def scaled_readings(factor: float) -> Correction:
    """Readings that are wrong by a factor of no name."""
    return Correction(
        "scale_factor", f"scale_mm has to be multiplied by {factor:.5g}",
        "check the resolution set in the readout", "scale_mm", _scaled(factor),
    )  # fmt: skip


def offset_angles(offsets_deg: tuple[float, float]) -> Correction:
    """A zero_at_deg that is far off."""
    wrong = tuple(i for i in (0, 1) if offsets_deg[i])
    by = " and ".join(f"{offsets_deg[i]:+.2f} deg" for i in wrong)
    return Correction(
        "zero_at", f"zero_at_deg of {joint_names(wrong)} is wrong by {by}",
        f"add {by} to zero_at_deg of {joint_names(wrong)} in the robot file and read the angles again",
        columns_of(wrong), _offset(offsets_deg),
    )  # fmt: skip


def _all(m: Measurements) -> NDArray[np.bool_]:
    return np.ones(len(m), dtype=bool)


def _scaled(factor: float) -> Callable[[Measurements], tuple[Measurements, NDArray[np.bool_]]]:
    def apply(m: Measurements) -> tuple[Measurements, NDArray[np.bool_]]:
        return replace(m, distance=m.distance * factor, came_from=None), _all(m)

    return apply


def _turned(
    joints: tuple[int, ...], factor: float, about_deg: tuple[float, float]
) -> Callable[[Measurements], tuple[Measurements, NDArray[np.bool_]]]:
    def apply(m: Measurements) -> tuple[Measurements, NDArray[np.bool_]]:
        theta = m.theta.copy()
        for i in joints:
            about = np.radians(about_deg[i])
            theta[:, i] = about + factor * (theta[:, i] - about)
        return _with_angles(m, theta), _all(m)

    return apply


def _offset(
    offsets_deg: tuple[float, float],
) -> Callable[[Measurements], tuple[Measurements, NDArray[np.bool_]]]:
    def apply(m: Measurements) -> tuple[Measurements, NDArray[np.bool_]]:
        return _with_angles(m, m.theta + np.radians(offsets_deg)), _all(m)

    return apply


def _exchanged(m: Measurements) -> tuple[Measurements, NDArray[np.bool_]]:
    return _with_angles(m, m.theta[:, ::-1].copy()), _all(m)


def _mirrored(m: Measurements) -> tuple[Measurements, NDArray[np.bool_]]:
    return _with_angles(m, np.pi - m.theta[:, ::-1]), _all(m)


def _shifted(
    joints: tuple[int, ...], by: int
) -> Callable[[Measurements], tuple[Measurements, NDArray[np.bool_]]]:
    """Take each value from `by` rows further down."""

    def apply(m: Measurements) -> tuple[Measurements, NDArray[np.bool_]]:
        source = np.arange(len(m)) + by
        there = (source >= 0) & (source < len(m))
        source = np.clip(source, 0, len(m) - 1)
        if not joints:
            return replace(m, distance=m.distance[source], came_from=None), there
        theta = m.theta.copy()
        for i in joints:
            theta[:, i] = theta[source, i]
        return _with_angles(m, theta), there

    return apply


def _with_angles(m: Measurements, theta: Real) -> Measurements:
    return replace(m, theta=theta, came_from=None)


def on_rows(m: Measurements, corrected: Measurements, rows: NDArray[np.bool_]) -> Measurements:
    """The file with the correction on some rows (K,) only."""
    return replace(
        m,
        theta=np.where(rows[:, None], corrected.theta, m.theta),
        distance=np.where(rows, corrected.distance, m.distance),
        came_from=None,
    )
