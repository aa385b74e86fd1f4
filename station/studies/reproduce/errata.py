"""Where the print errs or is silent, with the evidence computed on the spot."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from itertools import permutations

import numpy as np

from station.five_bar import Robot, forward, inverse
from station.published import conditioning, full_identification_matrix, identification_matrix
from station.studies.reproduce.figures import FIG_8_N
from station.studies.reproduce.position_error import before, six
from station.studies.reproduce.printed import GROUPS, KAPPA_1, KAPPA_M, TABLE_3, ZERO_OFFSETS_DEG

LAST_DIGIT_MM = 6e-4
NULL_SPACE = 1e-9
"""Singular values below this share of the largest are zero but for rounding."""


@dataclass(frozen=True)
class Erratum:
    """One place of the paper."""

    where: str
    printed: str
    found: str
    evidence: str


def errata(robot: Robot, scatter_deg: Mapping[str, float]) -> list[dict[str, str]]:
    """[{where, printed, found, evidence}]; scatter_deg is what the published method scatters by, by noise."""
    found = (_signs(robot), _inverse(robot), _rank(robot), _minus(robot), _monotone(robot), _order(robot))
    return [asdict(erratum) for erratum in (*found, _common_mode(), _before(), _noise(scatter_deg))]


def _signs(robot: Robot) -> Erratum:
    theta = inverse(robot.geometry, six(robot))
    kappas = []
    for cd in (-130j, 130j, -28j, 28j):
        geometry = type(robot.geometry)(robot.geometry.e, robot.geometry.L, robot.geometry.l, cd)
        kappas.append(
            f"c + d = {cd.imag:+.0f} mm: {np.linalg.cond(identification_matrix(geometry, theta)):.2f}"
        )
    return Erratum(
        "Table 1",
        "c = (0, 79), d = (0, 51), magnitudes",
        "c = (0, -79), d = (0, -51) mm",
        f"kappa_1 is printed as {KAPPA_1}; " + ", ".join(kappas),
    )


def _inverse(robot: Robot) -> Erratum:
    r = robot.workspace_grid(9, 7)
    closed = float(np.abs(forward(robot.geometry, inverse(robot.geometry, r)) - r).max())
    reach = r[:, None] - robot.geometry.e
    L, l = robot.geometry.L, robot.geometry.l  # noqa: E741
    C, D = -2 * L * reach.imag, -2 * L * reach.real
    E = np.abs(reach) ** 2 + L**2 - l**2
    with np.errstate(invalid="ignore"):
        printed = 2.0 * np.arctan((-C - np.sqrt(C**2 - D**2 + E**2)) / (D - E))
    off = np.degrees(np.abs(np.angle(np.exp(1j * (printed - inverse(robot.geometry, r))))))
    return Erratum(
        "eq. 3",
        "root of C^2 - D^2 + E^2, divisor D - E, one sign for both limbs",
        "root of C^2 + D^2 - E^2, divisor E - D, the sign of the root differs between the limbs",
        f"forward after inverse returns to the place within {closed:.1e} mm over the workspace; "
        f"as printed the angles are off by {np.nanmin(off):.0f} to {np.nanmax(off):.0f} deg",
    )


def _rank(robot: Robot) -> Erratum:
    rng = np.random.default_rng(0)
    ranks, ratio = [], 0.0
    for count in (13, 30, 90):
        places = rng.uniform(*robot.workspace_x, count) + 1j * rng.uniform(*robot.workspace_y, count)
        sigma = np.linalg.svd(
            full_identification_matrix(robot.geometry, inverse(robot.geometry, places)), compute_uv=False
        )
        ranks.append(f"K = {count}: {int(np.sum(sigma > NULL_SPACE * sigma[0]))}")
        ratio = max(ratio, float(sigma[9] / sigma[0]))
    return Erratum(
        "after eq. 24",
        "rank(G') = 12 for K >= 13",
        "9 for any K: two translations of base and mechanism together and the rotation about O_1 "
        "change no distance",
        f"rank at random places of the workspace: {', '.join(ranks)}; tenth singular value at most "
        f"{ratio:.0e} of the first",
    )


def _minus(robot: Robot) -> Erratum:
    theta, drm = inverse(robot.geometry, six(robot)), complex(*robot.drm)
    minus, plus = (
        float(np.linalg.cond(identification_matrix(robot.geometry, theta, sign * drm))) for sign in (1, -1)
    )
    return Erratum(
        "eq. 30",
        "f = lambda + dr_M",
        "f = lambda - dr_M",
        f"kappa_m is printed as {KAPPA_M}, below kappa_1; minus gives {minus:.2f}, plus {plus:.2f}",
    )


def _monotone(robot: Robot) -> Erratum:
    kappas = [f"{conditioning(robot, n).kappa_1:.2f}" for n in FIG_8_N]
    return Erratum(
        "section 6.1, Fig. 8",
        "kappa_1 and kappa_m monotonically increase with n",
        "not monotone in the order of positions that reproduces 475.34",
        f"kappa_1 for n = {FIG_8_N[0]} to {FIG_8_N[-1]}: {', '.join(kappas)}",
    )


def _order(robot: Robot) -> Erratum:
    theta = inverse(robot.geometry, six(robot))
    kappas = [
        float(np.linalg.cond(identification_matrix(robot.geometry, theta[list(order)])))
        for order in permutations(range(6))
    ]
    return Erratum(
        "eq. 23, section 5",
        "silent on the order of the positions",
        "adjacent differences make kappa depend on the order in which the same six positions are visited",
        f"all 720 orders: kappa_1 from {min(kappas):.0f} to {max(kappas):.0f}",
    )


def _common_mode() -> Erratum:
    signed = [np.subtract(row.compensation_deg, ZERO_OFFSETS_DEG[k % 3]) for k, row in enumerate(TABLE_3)]
    same = sum(bool(np.prod(error) > 0) for error in signed)
    common = max(abs(float(np.mean(e))) for e in signed)
    differential = max(abs(float(e[0] - e[1])) / 2 for e in signed)
    return Erratum(
        "Table 3",
        "delta around 0.040 deg (groups 1 to 3) and 0.025 deg (4 to 6), read as two independent errors",
        "one weak direction: both arms together with a sideways error of the mechanism",
        f"printed compensation less set value has the same sign on both joints in {same} of 6 groups; "
        f"common mode up to {common:.3f} deg, differential up to {differential:.3f} deg",
    )


def _before() -> Erratum:
    found = [before(group)["home_mm"] for group in GROUPS]
    off = [
        (group, row.before_mm, mine)
        for group, row, mine in zip(GROUPS, TABLE_3, found, strict=True)
        if abs(row.before_mm - mine) > LAST_DIGIT_MM
    ]
    return Erratum(
        "Table 3, column before",
        ", ".join(f"group {group}: {row}" for group, row, _ in off) + " mm",
        ", ".join(f"group {group}: {mine:.3f}" for group, _, mine in off) + " mm",
        f"forward model alone, without noise; the other {len(GROUPS) - len(off)} groups agree to the last "
        "digit printed",
    )


def _noise(scatter_deg: Mapping[str, float]) -> Erratum:
    size = max(max(row.delta_deg) for row in TABLE_3[:3])
    return Erratum(
        "section 6.1, Table 3",
        f"both noises (eq. 34 and 35) act in the simulation; delta up to {size} deg",
        "the printed size is that of the scale noise alone",
        "sd of the compensation value of dtheta1, group 1: "
        + ", ".join(f"{noise} {sd:.3f} deg" for noise, sd in scatter_deg.items()),
    )
