"""Fresh readings against the measurement sequence: what changed in between, or in the fresh file."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from station.diagnosis.mistakes.corrections import corrections
from station.diagnosis.mistakes.defects import slip
from station.diagnosis.mistakes.entries import WIDE_SLIP_RAD, moved_between, zeroed
from station.diagnosis.mistakes.fitting import Extra, Fitted, Rough, costs, fit, posterior
from station.diagnosis.mistakes.gross import AGREES_MM, SHORTEST, best_run, grown, zeroings
from station.diagnosis.mistakes.mistake import Mistake, ids, named
from station.five_bar import FiveBar, Robot
from station.records import Measurements, phrase

FAR_BETTER = 60.0
"""Minimum gain in deviance."""
WORSE = 3.0
"""Fresh readings are examined where they scatter this many times more than the earlier ones."""
CURED = 3.0
"""Factor by which a mistake's correction has to reduce their scatter."""
AGREEING = 0.85


def between(robot: Robot, m: Measurements, fresh: Measurements, sequence_fit: Fitted) -> Mistake | None:
    """The mistake that explains why fresh readings do not agree with `sequence_fit`."""
    mechanism = FiveBar(robot, fresh)
    with np.errstate(invalid="ignore"):
        residual = fresh.distance - mechanism.observe(sequence_fit.p, fresh.theta).value
    known = posterior(robot, m, sequence_fit)
    plain = fit(robot, fresh, prior=known, start=sequence_fit.p)
    limit = WORSE * max(sequence_fit.rms_mm, float(np.median(sequence_fit.row_sd)) / 2.0)
    if plain is not None and plain.rms_mm < limit and np.isfinite(residual).all() and _rms(residual) < limit:
        return None
    moved = _moved(robot, m, fresh, sequence_fit, plain, known)
    if moved is not None:
        return moved
    tolerance = max(AGREES_MM, 6.0 * sequence_fit.rms_mm)
    if np.mean(np.abs(residual) < tolerance) < AGREEING:
        return _gross(robot, fresh, sequence_fit, residual, tolerance)
    return None


def on_mounts(fresh: Measurements, m: Measurements) -> Measurements | None:
    """Fresh readings with their mounts numbered as in the sequence; None where one is not in it."""
    if any(name not in m.mounts for name in fresh.mounts):
        return None
    renumbered = np.array([m.mounts.index(name) for name in fresh.mounts])
    return replace(fresh, mount=renumbered[fresh.mount], mounts=m.mounts)


def _rms(residual: np.ndarray) -> float:
    return float(np.sqrt(np.nanmean(residual**2)))


def _gross(
    robot: Robot, fresh: Measurements, sequence_fit: Fitted, residual: np.ndarray, tolerance: float
) -> Mistake | None:
    mechanism = FiveBar(robot, fresh)
    here = costs(residual)
    best: tuple[float, Mistake, np.ndarray] | None = None
    for one in corrections(robot):
        corrected, used = one.apply(fresh)
        with np.errstate(invalid="ignore"):
            left = corrected.distance - mechanism.observe(sequence_fit.p, corrected.theta).value
        there = np.where(used, costs(left), here)
        rows = best_run(here - there)
        if rows is None or rows.sum() < SHORTEST:
            continue
        rows = grown(rows, ~used)
        good = np.where(rows & used, np.abs(left) < tolerance, np.abs(residual) < tolerance)[used | ~rows]
        if np.mean(good) < AGREEING:
            continue
        cost = float(np.sum(np.where(rows, there, here)[used | ~rows]))
        if best is None or cost < best[0] - 3.0:
            at_fault = ids(fresh, np.flatnonzero(rows))
            said = phrase("fresh_rows_agree_only", what=one.what, action=one.action, rows=named(at_fault))
            if len(at_fault) == len(fresh) or rows[used].all():
                said = phrase("fresh_agree_only", what=one.what, action=one.action)
            best = cost, Mistake(one.kind, said, at_fault, "refused", "fresh"), rows
    steps = zeroings(robot, fresh, Rough(sequence_fit.p, residual))
    if steps is not None and (best is None or steps.cost * len(fresh) < best[0]):
        rows = np.concatenate(steps.rows)
        left = residual.copy()
        for run, step in zip(steps.rows, steps.steps_mm, strict=True):
            left[run] -= step
        if np.mean(np.abs(left) < tolerance) >= AGREEING:
            return zeroed(fresh, np.sort(rows), steps.steps_mm[0], "fresh")
    return best[1] if best else None


def _moved(
    robot: Robot,
    m: Measurements,
    fresh: Measurements,
    sequence_fit: Fitted,
    plain: Fitted | None,
    known: tuple[np.ndarray, np.ndarray],
) -> Mistake | None:
    """Homed again, zeros written, or the readout zeroed, with everything else unchanged."""
    shifts = {
        joints: tuple(slip(fresh, i, 0, WIDE_SLIP_RAD) for i in joints) for joints in ((0,), (1,), (0, 1))
    }
    offset = (Extra("offset", 1000.0, by_reading=np.ones(len(fresh))),)
    drifted = Extra("drift", 0.2, by_reading=(fresh.t_s - fresh.t_s.mean()) / (np.ptp(fresh.t_s) or 1.0))
    tries = {
        name: fit(robot, fresh, prior=known, start=sequence_fit.p, extras=e) for name, e in shifts.items()
    }
    step = fit(robot, fresh, prior=known, start=sequence_fit.p, extras=offset)
    soft = fit(
        robot, fresh, prior=known, start=sequence_fit.p,
        extras=(drifted, Extra("offset", 0.05, by_reading=np.ones(len(fresh)))),
    )  # fmt: skip
    without = [found.deviance for found in (plain, soft) if found is not None]
    good = {name: found for name, found in tries.items() if found is not None}
    if step is not None and all(step.deviance < found.deviance - 10.0 for found in good.values()):
        if _cures(robot, fresh, sequence_fit, step, without):
            return zeroed(fresh, np.arange(len(fresh)), step.extra["offset"], "fresh")
        return None
    if not good:
        return None
    best = good[min(good, key=lambda name: good[name].deviance)]
    if not _cures(robot, fresh, sequence_fit, best, without):
        return None
    return moved_between(m, fresh, sequence_fit, best)


def _cures(
    robot: Robot, fresh: Measurements, sequence_fit: Fitted, found: Fitted, without: list[float]
) -> bool:
    """Whether it is far more probable than any other explanation, and leaves no more than the sequence."""
    frozen = float(
        np.sqrt(
            np.nanmean(
                (fresh.distance - FiveBar(robot, fresh).observe(sequence_fit.p, fresh.theta).value) ** 2
            )
        )
    )
    far = not without or min(without) - found.deviance > FAR_BETTER
    left = found.rms_mm < max(1.7 * sequence_fit.rms_mm, 1.5e-3)
    return far and left and frozen > CURED * found.rms_mm
