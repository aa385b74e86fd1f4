"""Wrong entries whose size a fit determines: robot file, mechanism, zeros, ratios, scale, steps in
between.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np

from station.diagnosis.mistakes.defects import (
    LARGEST_GAIN,
    LARGEST_LINK_MM,
    LARGEST_SCALE,
    best_moment,
    both_gains,
    gain,
    scale_gain,
    slip,
)
from station.diagnosis.mistakes.fitting import Extra, Fitted
from station.diagnosis.mistakes.mistake import Mistake, ids, joints_named, named
from station.five_bar import FiveBar, Robot
from station.records import Measurements, phrase

WIDE_MM = 30.0
WIDE_RAD = float(np.radians(60.0))
WIDE_RATIO = 0.2
WIDE_SLIP_RAD = float(np.radians(3.0))
MECHANISM_SDS = 5.0
"""Standard deviations of [mechanism] drm_sd_mm beyond which the mechanism is not as the file states."""
SAME_AS_EFFECT_MM = LARGEST_LINK_MM
"""Up to this size a wrong length in the file and a wrong part cannot be distinguished."""
SAME_AS_CENTRE_MM = 3.0
SAME_AS_EFFECT_RATIO = LARGEST_GAIN
SAME_AS_EFFECT_SCALE = LARGEST_SCALE
ZERO_MARGIN_DEG = 0.2
SMALLEST_STEP_DEG = 0.02
CLEAR_STEP_DEG = 0.1
SMALLEST_ZEROING_MM = 1.0
SURE = 6.0
CENTRES_PRICE = 16.0
"""Price in deviance: joint centres are machined together, a mechanism is mounted by hand, and both have
similar effects on the readings.
"""


@dataclass(frozen=True)
class Entry:
    """One hypothesis about an entry."""

    verdict: Callable[[Fitted], Mistake | None]
    """The mistake to report if it wins; None: too small to be a mistake."""
    loosened: Mapping[str, float] = field(default_factory=dict)
    extras: tuple[Extra, ...] = ()
    price: float = 0.0
    """Price of the search, in deviance."""


def entries(robot: Robot, m: Measurements, base: Fitted) -> Iterator[Entry]:
    """All hypotheses about entries."""
    names = [p.name for p in FiveBar(robot, m).parameters]
    drm = {name: WIDE_MM for name in names if name.startswith(("rMx", "rMy"))}
    yield Entry(lambda f: mechanism(robot, names, f), drm)
    yield Entry(lambda f: zero_at(robot, m, f), {"dtheta1": WIDE_RAD, "dtheta2": WIDE_RAD})
    for group in (("L1", "L2"), ("l1", "l2"), ("L1",), ("L2",), ("l1",), ("l2",)):
        yield Entry(_lengths(robot, names, group), dict.fromkeys(group, WIDE_MM))
    for group in (("e1x", "e2x"), ("e1y", "e2y"), ("e1x",), ("e2x",), ("e1y",), ("e2y",)):
        yield Entry(_lengths(robot, names, group), dict.fromkeys(group, WIDE_MM), price=CENTRES_PRICE)
    yield Entry(lambda f: _ratio(robot, f, "gain", (0, 1)), extras=(both_gains(robot, m, WIDE_RATIO),))
    for i in (0, 1):
        yield Entry(_one_ratio(robot, i), extras=(gain(robot, m, i, WIDE_RATIO),))
    yield Entry(_scale, extras=(scale_gain(m, WIDE_RATIO),))
    moments = 2.0 * float(np.log(len(m)))
    row = best_moment(robot, m, base, None)
    both = (slip(m, 0, row, WIDE_SLIP_RAD), slip(m, 1, row, WIDE_SLIP_RAD))
    yield Entry(lambda f: stepped(m, row, f), extras=both, price=moments)


def mechanism(robot: Robot, names: list[str], f: Fitted) -> Mistake | None:
    """dr_M, c or d is not as the robot file states."""
    off = [
        (name, f.p[names.index(name)] - robot.drm[axis], robot.drm_sd[axis], f.sd[names.index(name)])
        for axis, name in enumerate(("rMx", "rMy"))
    ]
    far = [(n, by) for n, by, sd, own in off if abs(by) > MECHANISM_SDS * sd and abs(by) > 4.0 * own]
    if not far:
        return None
    return Mistake(
        "mechanism",
        phrase(
            "mechanism",
            rms_um=f.rms_mm * 1e3,
            by=tuple(phrase("mm_in", size=by, axis=n[-1]) for n, by in far),
            x_mm=f.p[names.index("rMx")],
            y_mm=f.p[names.index("rMy")],
        ),
        (),
        "refused",
        "robot",
    )


def zero_at(
    robot: Robot, m: Measurements, f: Fitted, before_deg: tuple[float, float] = (0.0, 0.0)
) -> Mistake | None:
    """A zero offset beyond the tolerance; `before_deg` was added to the angles already."""
    tolerance = robot.tolerances.zero_offset_deg
    offset = np.degrees(f.p[:2]) + np.array(before_deg)
    sd = np.degrees(f.sd[:2])
    far = [i for i in (0, 1) if abs(offset[i]) > tolerance + 3.0 * min(sd[i], 1.0) + ZERO_MARGIN_DEG]
    if not far:
        return None
    new = [robot.zero_at_deg[i] + (offset[i] if i in far else 0.0) for i in (0, 1)]
    return Mistake(
        "zero_at",
        phrase(
            "zero_at",
            joints=tuple(
                phrase(
                    "reads_too_little" if offset[i] > 0 else "reads_too_much",
                    joint=i + 1,
                    size=abs(offset[i]),
                )
                for i in far
            ),
            tolerance_deg=tolerance,
            zero1_deg=new[0],
            zero2_deg=new[1],
        ),
        (),
        "refused",
        "robot",
    )


def _lengths(robot: Robot, names: list[str], group: tuple[str, ...]) -> Callable[[Fitted], Mistake | None]:
    def verdict(f: Fitted) -> Mistake | None:
        by = {name: float(f.p[names.index(name)]) for name in group}
        sure = any(abs(v) > SURE * f.sd[names.index(n)] for n, v in by.items())
        largest = max(abs(v) for v in by.values())
        centre = group[0].startswith("e")
        limit = SAME_AS_CENTRE_MM if centre else SAME_AS_EFFECT_MM
        tolerance = robot.tolerances.e_mm if centre else robot.tolerances.link_mm
        if not sure or largest < 6.0 * tolerance:
            return None
        return Mistake(
            "robot_file",
            phrase(
                "robot_file" if largest > limit else "robot_file_or_part",
                rms_um=f.rms_mm * 1e3,
                lengths=tuple(phrase("length_by", name=n, size=v) for n, v in by.items()),
                key="e" if centre else group[0][0],
            ),
            (),
            "refused" if largest > limit else "as_effect",
            "robot",
        )

    return verdict


def _ratio(robot: Robot, f: Fitted, name: str, joints: tuple[int, ...]) -> Mistake | None:
    by = f.extra[name]
    if abs(by) < SURE * f.extra_sd[name]:
        return None
    real = abs(by) <= SAME_AS_EFFECT_RATIO
    if real and len(joints) == 1:
        return None
    return Mistake(
        "ratio",
        phrase(
            "ratio_or_gear" if real else "ratio",
            joints=phrase("both_joints") if len(joints) == 2 else joints_named(joints),
            percent=by * 100,
            ratio=robot.ratio,
            better=robot.ratio / (1.0 + by),
        ),
        (),
        "as_effect" if real else "refused",
        "robot",
    )


def _one_ratio(robot: Robot, joint: int) -> Callable[[Fitted], Mistake | None]:
    return lambda f: _ratio(robot, f, f"gain{joint + 1}", (joint,))


def _scale(f: Fitted) -> Mistake | None:
    by = f.extra["scale"]
    if abs(by) < SURE * f.extra_sd["scale"]:
        return None
    real = abs(by) <= SAME_AS_EFFECT_SCALE
    return Mistake(
        "scale_factor",
        phrase("scale_factor_or_scale" if real else "scale_factor", percent=by * 100),
        (),
        "as_effect" if real else "refused",
    )


def stepped(m: Measurements, row: int, f: Fitted) -> Mistake | None:
    """Both joints step at one reading: zeros were written, or both were homed."""
    steps = [np.degrees(f.extra[f"slip{i + 1}"]) for i in (0, 1)]
    sds = [np.degrees(f.extra_sd[f"slip{i + 1}"]) for i in (0, 1)]
    before = np.degrees(f.p[:2])
    now = before + np.array(steps)
    written = _are_zeros(before, np.array(steps), np.degrees(f.sd[:2]) + np.array(sds))
    clear = [abs(s) > max(SMALLEST_STEP_DEG, SURE * sd) for s, sd in zip(steps, sds, strict=True)]
    # a joint with zero offset zero does not step when zeros are written
    if not all(clear) and not (written and any(clear) and max(map(abs, steps)) > CLEAR_STEP_DEG):
        return None
    rows = ids(m, range(row, len(m)))
    return Mistake(
        "zeros_written" if written else "rehomed",
        phrase(
            "zeros_written_within" if written else "homed_within",
            reading=named(rows[:1]),
            step1_deg=steps[0],
            step2_deg=steps[1],
            now1_deg=now[0],
            now2_deg=now[1],
        ),
        rows,
        "refused",
    )


def _are_zeros(before: np.ndarray, steps: np.ndarray, sd: np.ndarray) -> bool:
    """Whether the steps are the zero offsets, with either sign."""
    room = 3.0 * sd + 0.05
    return bool(np.all(np.abs(steps + before) < room) or np.all(np.abs(steps - before) < room))


def moved_between(m: Measurements, fresh: Measurements, sequence_fit: Fitted, f: Fitted) -> Mistake | None:
    """One joint or both have an offset in the fresh readings: homed or written in between."""
    steps = np.degrees([f.extra.get(f"slip{i + 1}", 0.0) for i in (0, 1)])
    sds = np.degrees([f.extra_sd.get(f"slip{i + 1}", 0.0) for i in (0, 1)])
    moved = [i for i in (0, 1) if abs(steps[i]) > max(SMALLEST_STEP_DEG, SURE * sds[i])]
    if not moved:
        return None
    before = np.degrees(sequence_fit.p[:2])
    written = len(moved) == 2 and _are_zeros(before, steps, np.degrees(sequence_fit.sd[:2]) + sds)
    return Mistake(
        "zeros_written" if written else "rehomed",
        phrase(
            "zeros_written_between" if written else "homed_between",
            moved=tuple(phrase("joint_shifted", joint=i + 1, step_deg=steps[i]) for i in moved),
        ),
        ids(fresh, range(len(fresh))),
        "refused",
        "fresh",
    )


def zeroed(m: Measurements, rows: np.ndarray, step_mm: float, file: str = "readings") -> Mistake | None:
    """The readout counts from another zero on some rows."""
    if abs(step_mm) < SMALLEST_ZEROING_MM:
        return None
    at_fault = ids(m, rows)
    said = phrase("zeroed_in", rows=named(at_fault), step_mm=step_mm)
    if file == "fresh" and len(rows) == len(m):
        said = phrase("zeroed_fresh", step_mm=step_mm)
    elif rows[-1] == len(m) - 1:
        said = phrase("zeroed_from", reading=named(at_fault[:1]), step_mm=step_mm)
    return Mistake(
        "readout_zeroed",
        said,
        at_fault,
        "refused",
        "fresh" if file == "fresh" else "readings",
    )
