"""Defects of the machine itself: the explanations that a mistake has to exceed.

Each is a few columns with realistic sizes. They are no diagnosis: they only show how well the readings can be
explained without any mistake.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from station.diagnosis.mistakes.fitting import OFFSET_SD_MM, Extra, Fitted, fit
from station.five_bar import FiveBar, Robot
from station.records import Measurements, Real

LINK_MM = 3.0
GAIN = 0.005
SCALE_GAIN = 0.002
ECCENTRIC_RAD = float(np.radians(0.15))
PLAY_RAD = float(np.radians(0.02))
FAR_MM = 1.0
LARGEST_LINK_MM = 10.0
LARGEST_GAIN = 0.03
LARGEST_SCALE = 0.02
"""Beyond these a part could not be mounted, or is another part."""
SLIP_RAD = float(np.radians(0.3))
STEP_MM = 0.05
BOW_MM = 0.1
TRAVEL_MM = 100.0


def drive_angle(robot: Robot, theta: Real) -> Real:
    """(K, 2) from each drive's zero, rad."""
    return np.asarray(theta - np.radians(robot.zero_at_deg))


def gain(robot: Robot, m: Measurements, joint: int, sd: float = GAIN) -> Extra:
    """Ratio of one joint, relative."""
    return Extra(f"gain{joint + 1}", sd, by_angle=_only(drive_angle(robot, m.theta), joint))


def both_gains(robot: Robot, m: Measurements, sd: float = GAIN) -> Extra:
    """One ratio of both joints, relative."""
    return Extra("gain", sd, by_angle=drive_angle(robot, m.theta))


def scale_gain(m: Measurements, sd: float = SCALE_GAIN) -> Extra:
    """Scale factor of the readings, relative."""
    return Extra("scale", sd, by_reading=m.distance - np.median(m.distance))


def smooth(robot: Robot, m: Measurements) -> tuple[Extra, ...]:
    """All smooth defects at once: gains, eccentricities once and twice per turn, sag, bow."""
    out = [scale_gain(m)]
    for joint in (0, 1):
        out.append(gain(robot, m, joint))
        angle = m.theta[:, joint]
        for waves in (1, 2):
            for name, wave in (("sin", np.sin), ("cos", np.cos)):
                column = np.zeros_like(m.theta)
                column[:, joint] = wave(waves * angle)
                out.append(Extra(f"{name}{waves}{joint}", ECCENTRIC_RAD / waves**2, by_angle=column))
    centred = (m.distance - np.median(m.distance)) / TRAVEL_MM
    out.append(Extra("bow", BOW_MM, by_reading=centred**2))
    return tuple(out)


def plays(m: Measurements) -> tuple[Extra, ...]:
    """Half widths of the joints' backlash."""
    return tuple(
        Extra(f"play{i + 1}", PLAY_RAD, by_angle=-_only(m.approach.astype(float), i))
        for i in (0, 1)
        if m.approach[:, i].any()
    )


def drift(m: Measurements) -> Extra:
    """Drift of the reading over the file's time."""
    length = float(np.ptp(m.t_s)) or 1.0
    return Extra("drift", STEP_MM, by_reading=(m.t_s - m.t_s.mean()) / length)


@dataclass(frozen=True)
class WithoutAMistake:
    """Minus twice the log evidence of the unchanged readings, under the best explanation of each sort."""

    simple: float
    """No defect, or one defect."""
    everything: float
    """All smooth defects at once, which imitate many other errors."""


def without_a_mistake(robot: Robot, m: Measurements, base: Fitted) -> WithoutAMistake:
    """All explanations of this module that converge with a realistic size."""
    simple, everything = accounts(robot, m, base)
    return WithoutAMistake(
        min(one.deviance for one in simple), min((one.deviance for one in everything), default=np.inf)
    )


def accounts(robot: Robot, m: Measurements, base: Fitted) -> tuple[list[Fitted], list[Fitted]]:
    """The simple explanations, the base model first, and those with all smooth defects."""
    if base.rms_mm > FAR_MM:
        # among the defects of this module only a slip has as large an effect
        return [base, *(found for found in slips(robot, m, base) if found is not None)], []
    links = dict.fromkeys(("L1", "L2", "l1", "l2"), LINK_MM)
    some = plays(m)
    tries = [
        fit(robot, m, extras=(*some, drift(m)), start=base.p),
        *(fit(robot, m, loosened={name: LINK_MM}, start=base.p) for name in links),
        *(fit(robot, m, loosened={n + "1": LINK_MM, n + "2": LINK_MM}, start=base.p) for n in "Ll"),
        fit(robot, m, extras=(both_gains(robot, m),), start=base.p),
        fit(robot, m, extras=(gain(robot, m, 0), gain(robot, m, 1)), start=base.p),
        fit(robot, m, extras=(scale_gain(m),), start=base.p),
    ]
    tries += slips(robot, m, base)
    everything = [
        fit(robot, m, extras=smooth(robot, m), start=base.p),
        fit(robot, m, extras=(*smooth(robot, m), *some, drift(m)), loosened=links, start=base.p),
    ]
    occurring = [
        [found for found in group if found is not None and _occurs(robot, m, found)]
        for group in (tries, everything)
    ]
    return [base, *occurring[0]], occurring[1]


def _occurs(robot: Robot, m: Measurements, found: Fitted) -> bool:
    """Whether its sizes occur in machines, rather than only in files."""
    names = [p.name for p in FiveBar(robot, m).parameters]
    links = max(abs(found.p[names.index(name)]) for name in ("L1", "L2", "l1", "l2"))
    ratios = max((abs(v) for n, v in found.extra.items() if n.startswith("gain")), default=0.0)
    return bool(
        links <= LARGEST_LINK_MM
        and ratios <= LARGEST_GAIN
        and abs(found.extra.get("scale", 0.0)) <= LARGEST_SCALE
    )


def slips(robot: Robot, m: Measurements, base: Fitted) -> list[Fitted | None]:
    """A slip of one joint at the moment that fits best."""
    found = []
    for joint in (0, 1):
        row = best_moment(robot, m, base, joint)
        found.append(fit(robot, m, start=base.p, extras=(slip(m, joint, row), *plays(m))))
    return found


def best_moment(robot: Robot, m: Measurements, base: Fitted, joint: int | None) -> int:
    """Row from which a step of a joint's angle (None: of both, with separate sizes) reduces a fit's residual
    most.
    """
    mechanism = FiveBar(robot, m)
    at = mechanism.observe(base.p, m.theta)
    sd = base.row_sd * base.noise
    spread = np.array([min(p.prior_sd, OFFSET_SD_MM) for p in mechanism.parameters])
    q = np.linalg.qr(np.vstack([at.by_parameter / sd[:, None], np.diag(1.0 / spread)]))[0][: len(m)]
    left = base.residual_mm / sd
    left = left - q @ (q.T @ left)
    after = np.tril(np.ones((len(m), len(m))))[:, 2 : len(m) - 1]  # column r: 1 from row r + 2 on
    won = np.zeros(after.shape[1])
    joints = (0, 1) if joint is None else (joint,)
    columns = []
    for j in joints:
        c = after * (at.by_joint[:, j] / sd)[:, None]
        columns.append(c - q @ (q.T @ c))
    if joint is not None:
        won = (left @ columns[0]) ** 2 / np.maximum(np.sum(columns[0] ** 2, axis=0), 1e-12)
    else:
        for k in range(after.shape[1]):
            pair = np.column_stack([columns[0][:, k], columns[1][:, k]])
            y = left @ pair
            won[k] = float(y @ np.linalg.lstsq(pair.T @ pair, y, rcond=1e-9)[0])
    return int(np.argmax(won)) + 2


def slip(m: Measurements, joint: int, row: int, sd: float = SLIP_RAD) -> Extra:
    """The joint deviates from its feedback from a row on."""
    column = np.zeros_like(m.theta)
    column[row:, joint] = 1.0
    return Extra(f"slip{joint + 1}", sd, by_angle=column)


def _only(columns: Real, joint: int) -> Real:
    """(K, 2) with zeros for the other joint."""
    out = np.zeros_like(columns)
    out[:, joint] = columns[:, joint]
    return out
