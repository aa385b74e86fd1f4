"""What an unexplained residual depends on, found without the catalogue.

Each test's null hypothesis is that the residual does not depend on the thing named; Holm's procedure
keeps the chance of any false hint at `LEVEL`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial import KDTree
from scipy.special import fdtrc, ndtr

from station.diagnosis.model import Fit
from station.kinematics import Real
from station.mechanism import axis_of_row

LEVEL = 0.01
NEAREST = 6
LOCAL_SHARE = 0.15
"""Of what the sense of approach does, the part that differs from place to place where it counts."""


@dataclass(frozen=True)
class Hint:
    """One thing the residual depends on."""

    depends_on: str
    strength: float
    """Share of the residual's square that goes with it, 0 to 1."""
    p_value: float
    text: str


def hints(fit: Fit, noise_sd_mm: float, *, repeats_agree: bool) -> tuple[Hint, ...]:
    """Significant dependences of a fit's residual, strongest first.

    noise_sd_mm is the scatter of repeats.  Where repeats of one place disagree more than the devices
    are specified for, something changed between them: that is time's, and no place's or angle's.
    """
    axis = axis_of_row(fit.model.mechanism)
    each = [
        list(_tests(fit, fit.residual_mm[axis == a], noise_sd_mm, repeats_agree)) for a in np.unique(axis)
    ]
    found = sorted(map(_strongest, zip(*each, strict=True)), key=lambda h: h.p_value)
    kept = []
    for k, hint in enumerate(found):
        if hint.p_value * (len(found) - k) > LEVEL:
            break
        kept.append(hint)
    return tuple(sorted(kept, key=lambda h: -h.strength))


def _strongest(coordinates: tuple[Hint, ...]) -> Hint:
    """One thing looked at in every coordinate: the plainest, with the price of looking that often."""
    plainest = min(coordinates, key=lambda h: h.p_value)
    return replace(plainest, p_value=min(1.0, plainest.p_value * len(coordinates)))


def _tests(fit: Fit, r: Real, noise_sd_mm: float, repeats_agree: bool) -> Iterator[Hint]:
    """Of one coordinate's residual r (K,), mm."""
    m = fit.model.mechanism.measurements
    c = fit.conditions
    if not repeats_agree:
        yield _ordered("time", r, m.t_s, 1.0, "The residual changes with time.")
        if c.temperature_rise is not None:
            yield _ordered("temperature", r, c.temperature_rise, 1.0, "It follows the temperature.")
        return
    place, _ = _by_group(r, m.position)
    share = float(place @ place) / float(r @ r)
    if np.any(c.approach != 0):
        yield from _by_approach(fit, r, noise_sd_mm)
    yield _at_a_place(fit, place, share)
    for i in range(m.joints):
        text = f"The residual follows the angle of joint {i + 1}."
        yield _ordered(f"theta{i + 1}", place, c.theta[:, i], share, text)
    if np.ptp(c.travel) > 0:
        yield _ordered("travel", place, c.travel, share, "The residual follows the measured distance.")


def _by_group(r: Real, group: np.ndarray) -> tuple[Real, int]:
    """(K,) group means, and the number of groups."""
    index = np.unique(group, axis=0, return_inverse=True)[1].reshape(-1)
    counts = np.bincount(index)
    return (np.bincount(index, r) / counts)[index], len(counts)


def _ordered(name: str, r: Real, along: Real, share: float, text: str) -> Hint:
    """von Neumann's ratio of r ordered along something: neighbours alike mean dependence."""
    ordered = r[np.argsort(along, kind="stable")]
    square, n = float(ordered @ ordered), len(ordered)
    if square == 0.0 or n < 12:
        return Hint(name, 0.0, 1.0, text)
    ratio = float(np.sum(np.diff(ordered) ** 2)) / square
    z = (ratio - 2.0) / np.sqrt(4.0 * (n - 2) / (n**2 - 1))
    return Hint(name, share * float(np.clip(1.0 - ratio / 2.0, 0.0, 1.0)), float(ndtr(z)), text)


def _by_approach(fit: Fit, r: Real, noise_sd_mm: float) -> Iterator[Hint]:
    """Does the sense of approach matter, everywhere alike or differently from place to place?"""
    m = fit.model.mechanism.measurements
    senses = np.column_stack([fit.conditions.slider_direction, m.approach])
    place, places = _by_group(r, m.position)
    cell, cells = _by_group(r, np.column_stack([m.position, senses]))
    if cells <= places + senses.shape[1]:
        return
    centred = senses - np.column_stack([_by_group(s.astype(float), m.position)[0] for s in senses.T])
    alike = centred @ np.linalg.lstsq(centred, r - place, rcond=None)[0]
    whole, common = float(r @ r), float(alike @ alike)
    within, apart = float((r - place) @ (r - place)), float((cell - place) @ (cell - place))
    columns, spare = senses.shape[1], max(len(r) - places - senses.shape[1], 1)
    dof = cells - places - columns
    local = max(apart - common, 0.0)
    p_alike = float(fdtrc(columns, spare, (common / columns) / ((within - common) / spare)))
    p_local = float(fdtrc(dof, max(len(r) - cells, 1), local / dof / noise_sd_mm**2))
    if p_local < LEVEL and local > LOCAL_SHARE * apart:
        yield Hint(
            "approach x place",
            apart / whole,
            p_local,
            "The residual depends on the sense of approach, differently from place to place: "
            "something drags on the platform (a cable, a hose).",
        )
    else:
        yield Hint(
            "approach",
            common / whole,
            p_alike,
            "The residual depends on the sense of approach, everywhere alike.",
        )


def _at_a_place(fit: Fit, place: Real, share: float) -> Hint:
    """Moran's I of the mean residual of each place with its nearest neighbours, and where it is largest."""
    m = fit.model.mechanism.measurements
    at = fit.model.mechanism.places(fit.x[: fit.model.base_size])
    _, first = np.unique(m.position, return_index=True)
    value, where = place[first], at[first]
    n = len(first)
    text = "The residual belongs to a place in the workspace."
    if n < 2 * NEAREST:
        return Hint("place", 0.0, 1.0, text)
    z = value - value.mean()
    near = np.asarray(KDTree(where).query(where, NEAREST + 1)[1])[:, 1:]
    rng = np.random.default_rng(0)
    moran = _moran(z, near)
    shuffled = np.array([_moran(rng.permutation(z), near) for _ in range(400)])
    p_normal = float(1.0 - ndtr((moran - shuffled.mean()) / max(shuffled.std(), 1e-12)))
    peak = int(np.argmax(np.abs(z)))
    gathered = _share_at_peak(z, where, where[peak])
    peak_at = ", ".join(f"{name} = {v:.0f}" for name, v in zip("xyz", where[peak], strict=False))
    # a dent is an extreme of the few: judged by how far the largest stands out of the middle of all
    middle = 1.4826 * float(np.median(np.abs(z - np.median(z)))) or 1e-12
    extreme = float(min(1.0, 2.0 * n * (1.0 - ndtr(np.abs(z[peak]) / middle))))
    return Hint(
        "place",
        share * float(max(gathered, np.clip(moran, 0.0, 1.0))),
        max(min(p_normal, extreme) * 2.0, 1e-300),
        f"{text[:-1]}, most at {peak_at} mm.",
    )


def _moran(z: Real, near: np.ndarray) -> float:
    square = float(z @ z)
    return float(np.sum(z[:, None] * z[near]) / near.shape[1] / square) if square else 0.0


def _share_at_peak(z: Real, where: Real, peak: Real) -> float:
    inside = np.linalg.norm(where - peak, axis=1) < 60.0
    return float(z[inside] @ z[inside] / (z @ z))
