"""Changes of a file that undo one mistake each: of the readings, the angles, or the order of the rows."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.diagnosis.mistakes.mistake import Kind, angle_columns, joints_named, rows_named
from station.five_bar import Robot
from station.records import Measurements, Phrase, Real, phrase

SCALE_UNITS = {
    "in_inches": 25.4, "in_metres": 1e3, "in_micrometres": 1e-3, "in_centimetres": 10.0,
    "in_tenths_of_a_millimetre": 0.1, "in_thousandths_of_an_inch": 0.0254, "in_feet": 304.8,
    "in_nanometres": 1e-6,
}  # fmt: skip
"""Units by the code of their names."""
SCALE_FACTORS = {
    "share_twice": 0.5, "share_half": 2.0, "share_four_times": 0.25, "share_quarter": 4.0,
    "share_five_times": 0.2, "share_fifth": 5.0,
}  # fmt: skip
"""Factors of readings that are too large (wrong interpolation or edge counting), and the correction."""
ANGLE_UNITS = {
    "in_radians": 180.0 / np.pi, "in_minutes_of_arc": 1.0 / 60.0, "in_seconds_of_arc": 1.0 / 3600.0,
    "in_milliradians": 0.18 / np.pi, "in_gon": 0.9, "in_turns": 360.0, "in_tenths_of_a_degree": 0.1,
    "in_thousandths_of_a_degree": 1e-3,
}  # fmt: skip
SHIFTS = (1, -1, 2, -2, 3, -3)
BOTH: tuple[tuple[int, ...], ...] = ((0,), (1,), (0, 1))
AT_MOST_ONE: tuple[tuple[int, ...], ...] = ((), (0,), (1,))


@dataclass(frozen=True)
class Correction:
    """One way to correct a file."""

    kind: Kind
    what: Phrase
    """What is wrong, as the end of "... looks as if": a full clause."""
    action: Phrase
    """What to do, an imperative clause."""
    joints: tuple[int, ...]
    """The joints whose angles it changes; none: the readings or the order of the rows."""
    apply: Callable[[Measurements], tuple[Measurements, NDArray[np.bool_]]]
    """The corrected file, and the rows that are still complete."""


def corrections(robot: Robot) -> Iterator[Correction]:
    """All corrections that need no searched number."""
    yield Correction("scale_sign", phrase("scale_backwards"), phrase("reverse_scale"), (), _scaled(-1.0))
    for unit, factor in SCALE_UNITS.items():
        yield Correction(
            "scale_unit", phrase("scale_in_unit", unit=phrase(unit)),
            phrase("multiply_scale", factor=factor), (), _scaled(factor),
        )  # fmt: skip
    for share, factor in SCALE_FACTORS.items():
        yield Correction(
            "scale_factor", phrase("scale_share", share=phrase(share)),
            phrase("multiply_scale", factor=factor), (), _scaled(factor),
        )  # fmt: skip
    for unit, factor in ANGLE_UNITS.items():
        for joints in BOTH:
            columns = angle_columns(joints)
            yield Correction(
                "angle_unit", phrase("angles_in_unit", columns=columns, unit=phrase(unit)),
                phrase("multiply_angles", columns=columns, factor=factor),
                joints, _turned(joints, factor, (0.0, 0.0)),
            )  # fmt: skip
    for joints in BOTH:
        yield Correction(
            "joint_sign", phrase("joint_backwards", joints=joints_named(joints)), phrase("reverse_joint"),
            joints, _turned(joints, -1.0, robot.zero_at_deg),
        )  # fmt: skip
        if any(robot.zero_at_deg[i] % 180.0 for i in joints):
            yield Correction(
                "joint_sign", phrase("angles_negative", columns=angle_columns(joints)),
                phrase("reverse_angles"), joints, _turned(joints, -1.0, (0.0, 0.0)),
            )  # fmt: skip
    yield Correction(
        "joints_exchanged", phrase("columns_exchanged"), phrase("exchange_columns"), (0, 1), _exchanged
    )
    yield Correction(
        "joints_exchanged", phrase("joints_exchanged"), phrase("exchange_joints"), (0, 1), _mirrored
    )
    for by in SHIFTS:
        rows, late = rows_named(by), by > 0
        for joints in AT_MOST_ONE:
            what = phrase("scale_late" if late else "scale_early", rows=rows)
            if joints:
                code = "column_late" if late else "column_early"
                what = phrase(code, column=angle_columns(joints), rows=rows)
            action = phrase("move_up" if late else "move_down", rows=rows)
            yield Correction("row_shift", what, action, joints, _shifted(joints, by))


def scaled_angles(joints: tuple[int, ...], factor: float, about_deg: tuple[float, float]) -> Correction:
    """A ratio in [joints] that is wrong by the reciprocal of a factor."""
    return Correction(
        "ratio", phrase("ratio_by_factor", joints=joints_named(joints), factor=factor),
        phrase("divide_ratio", factor=factor), joints, _turned(joints, factor, about_deg),
    )  # fmt: skip


def scaled_readings(factor: float) -> Correction:
    """Readings that are wrong by an arbitrary factor."""
    return Correction(
        "scale_factor", phrase("scale_by_factor", factor=factor), phrase("check_resolution"), (),
        _scaled(factor),
    )  # fmt: skip


def offset_angles(offsets_deg: tuple[float, float]) -> Correction:
    """A zero_at_deg with a large error."""
    wrong = tuple(i for i in (0, 1) if offsets_deg[i])
    by = tuple(phrase("degrees", value=offsets_deg[i]) for i in wrong)
    return Correction(
        "zero_at", phrase("zero_by", joints=joints_named(wrong), by=by),
        phrase("add_zero", joints=joints_named(wrong), by=by), wrong, _offset(offsets_deg),
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
    """The file with the correction applied to some rows (K,) only."""
    return replace(
        m,
        theta=np.where(rows[:, None], corrected.theta, m.theta),
        distance=np.where(rows, corrected.distance, m.distance),
        came_from=None,
    )
