"""The five-bar as a mechanism: the measurement model (docs/explanation/method.md) with its derivatives.

s_k = rho(theta_fb,k + dtheta; e, L, l, dr_M) - rho_0, one rho_0 and one dr_M per mount.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np

from station.five_bar.error_model import (
    NAMES,
    SIZE,
    distance_by_joint,
    distance_jacobian,
    perturbed,
    pose,
    position_jacobian,
)
from station.five_bar.kinematics import Geometry, inverse
from station.five_bar.plausibility import check_distances, check_poses
from station.five_bar.references import with_references
from station.five_bar.robot_file import FIVE_BAR_MODEL, MOST_ZERO_OFFSET, Robot
from station.mechanism import (
    Conditions,
    Observation,
    Parameter,
    Reference,
    last_motion,
    net_travel,
    readings_before,
    temperature_rise,
)
from station.records import Complex, Index, Measurements, Real

SCALE_SD_MM = (3.0 + 0.35) / 3.0 * 1e-3
"""Eq. 34 for the 350 mm scale."""
UNKNOWN_MOUNT_SD_MM = 300.0
"""Prior of c where the robot file does not state the position of a mount."""
IMPOSSIBLE_SDS = 20.0
"""A parameter this many tolerances from nominal indicates a wrong file or a missing effect."""
GRID = (9, 7)
"""Points of the workspace at which position errors are predicted."""


class FiveBar:
    """Parameters: the twelve of the error model, (rMx, rMy) of further mounts, rho_0 of each mount."""

    model = FIVE_BAR_MODEL
    needs_repeats = True

    def __init__(self, robot: Robot, measurements: Measurements) -> None:
        self.robot = robot
        self.measurements = measurements
        self.nominal = robot.geometry
        self.theta = measurements.theta
        self.measured = measurements.distance
        self.reading_of_row: Index = np.arange(len(measurements))
        self._mount = measurements.mount
        c = np.array([complex(*(robot.mount_of(name) or robot.c)) for name in measurements.mounts])
        self._cd = c + complex(*robot.d)
        self._extra = len(measurements.mounts) - 1

    @cached_property
    def parameters(self) -> tuple[Parameter, ...]:
        """The unknowns with the priors of the robot file and of its references."""
        return with_references(self._by_tolerance, self.robot)

    @cached_property
    def _by_tolerance(self) -> tuple[Parameter, ...]:
        robot, tolerance = self.robot, self.robot.tolerances
        zero_sd = np.radians(tolerance.zero_offset_deg)
        degrees = 180.0 / np.pi
        out = [Parameter(name, "zero_offset", "deg", 0.0, zero_sd, degrees) for name in NAMES[:2]]
        out += [Parameter(name, "geometry", "mm", 0.0, tolerance.e_mm) for name in NAMES[2:6]]
        out += [Parameter(name, "geometry", "mm", 0.0, tolerance.link_mm) for name in NAMES[6:10]]
        for label in self.measurements.mounts:
            suffix = "" if label == self.measurements.mounts[0] else f"@{label}"
            known = not suffix or robot.mount_of(label) is not None
            for axis, name in enumerate(("rMx", "rMy")):
                sd = robot.drm_sd[axis] if known else UNKNOWN_MOUNT_SD_MM
                out.append(Parameter(name + suffix, "mechanism", "mm", robot.drm[axis], sd))
        for label in self.measurements.mounts:
            suffix = "" if label == self.measurements.mounts[0] else f"@{label}"
            out.append(Parameter("rho0" + suffix, "reading_offset", "mm", 0.0, np.inf))
        return tuple(out)

    @property
    def simplest(self) -> tuple[str, tuple[str, ...]]:
        """The paper's four unknowns of eq. 28, with the reading offset."""
        return "paper", tuple(p.name for p in self.parameters if p.role != "geometry")

    def of(self, measurements: Measurements) -> FiveBar:
        """The same robot with other readings."""
        return FiveBar(self.robot, measurements)

    def check(self) -> None:
        """:raises InputRefused: poses or distances are impossible for this robot."""
        check_poses(self.robot, self.measurements)
        check_distances(self.robot, self.measurements)

    @cached_property
    def row_sd(self) -> Real:
        """(K,) head noise (eq. 34), half a step of a coarse readout, and the half pulse that feedback does
        not resolve, through d rho / d theta.
        """
        joint_sd = np.radians(self.robot.joint_sd_deg)
        by_joint = distance_by_joint(pose(self.geometry_at(self.start), self.theta))
        step_variance = self.measurements.resolution_mm**2 / 12  # of a uniform distribution (GUM, F.2.2.1)
        head_variance = SCALE_SD_MM**2 / self.measurements.samples + step_variance
        return np.asarray(np.sqrt(head_variance + joint_sd**2 * np.sum(by_joint**2, axis=1)))

    @property
    def start(self) -> Real:
        """(P,) the prior mean."""
        return np.array([p.prior_mean for p in self.parameters])

    def geometry_at(self, p: Real) -> Geometry:
        """The geometry at parameters p (P,); with several mounts c + d is (K,), one per reading."""
        geometry = perturbed(self.nominal, p[:SIZE])
        if not self._extra:
            return geometry
        drm = np.concatenate([p[10:12], p[SIZE : SIZE + 2 * self._extra]])
        cd = self._cd + drm[0::2] + 1j * drm[1::2]
        return Geometry(geometry.e, geometry.L, geometry.l, cd[self._mount])

    def observe(self, p: Real, theta: Real) -> Observation:
        """(K,) head readings with derivatives; NaN where the linkage does not close."""
        geometry = self.geometry_at(p)
        at = pose(geometry, theta + p[:2])
        jacobian = distance_jacobian(geometry, at)
        return Observation(at.rho - self.offset(p), self.by_parameter(jacobian), jacobian[:, :2])

    def offset(self, p: Real) -> Real:
        """(K,) rho_0 of each reading's mount at parameters p (P,), mm."""
        return np.asarray(p[SIZE + 2 * self._extra :][self._mount])

    def by_parameter(self, jacobian: Real) -> Real:
        """(K, P) d s / d p from d rho / d p (K, 12) of each reading's own geometry."""
        if not self._extra:
            full = np.empty((len(jacobian), SIZE + 1))
            full[:, :SIZE] = jacobian
            full[:, SIZE] = -1.0
            return full
        drm, offset = self._by_mount(jacobian[:, 10:12])
        return np.hstack([jacobian[:, :10], drm, offset])

    def _by_mount(self, by_drm: Real) -> tuple[Real, Real]:
        """Assign d rho / d dr_M and d s / d rho_0 to the columns of each reading's own mount."""
        mounts = 1 + self._extra
        own = self._mount[:, None] == np.arange(mounts)
        drm = (own[:, :, None] * by_drm[:, None, :]).reshape(len(by_drm), 2 * mounts)
        return drm, -own.astype(float)

    def conditions(self, p: Real, reference: Reference, *, first: bool) -> Conditions:
        """The conditions of the readings; `first` when the model is being learned from them."""
        m = self.measurements
        theta = m.theta + p[:2]
        at = pose(perturbed(self.nominal, p[:SIZE]), theta)
        came_from = readings_before(m, None if first else reference)
        direction, by_each = last_motion(m, distance_by_joint(at), came_from)
        return Conditions(
            t_s=m.t_s,
            theta=theta,
            drive_angle=m.theta - np.radians(self.robot.zero_at_deg),
            approach=m.approach.astype(float),
            travel=self.observe(p, m.theta).value,
            slider_direction=direction,
            slider_by_joint=by_each,
            slider_net=net_travel(m, came_from),
            temperature_rise=temperature_rise(m, reference),
            payload_kg=m.payload_kg,
            lengths=lengths(self.robot),
            pull=pull(at.w),
            load=load(theta),
        )

    def places(self, p: Real) -> Real:
        """(K, 2) position of P at each reading, mm."""
        r = pose(perturbed(self.nominal, p[:SIZE]), self.theta + p[:2]).r
        return np.column_stack([r.real, r.imag])

    @property
    def workspace(self) -> Complex:
        """(G,) positions at which position errors are predicted, mm."""
        return self.robot.workspace_grid(*GRID)

    def implausible(self, p: Real) -> str:
        """Why a parameter is implausible, by name: a link 3 mm off is a wrong robot file or column."""
        offset = np.array(
            [abs(x - q.prior_mean) / q.prior_sd for x, q in zip(p, self._by_tolerance, strict=True)]
        )
        worst = int(np.argmax(offset))
        limit_deg = MOST_ZERO_OFFSET * self.robot.tolerances.zero_offset_deg
        if offset[worst] <= IMPOSSIBLE_SDS and (np.degrees(np.abs(p[:2])) <= limit_deg).all():
            return ""
        q = self._by_tolerance[worst]
        return f"{q.name} would be {p[worst] * q.shown:.3f} {q.unit}, {offset[worst]:.0f} times its tolerance"

    def position_errors(self, p: Real) -> tuple[Real, Real]:
        """Errors over the workspace grid, commanded by nominal inverse position, zero offsets uncompensated.

        Position at p less the commanded one (G, 2), and d (x, y) / d p (G, 2, P).
        """
        return self.position_errors_at(p, self.workspace)

    def position_errors_at(self, p: Real, target: Complex) -> tuple[Real, Real]:
        """The same at other commanded positions (G,), mm.

        :raises Unreachable: naming the first position out of reach.
        """
        theta = inverse(self.nominal, target)
        geometry = perturbed(self.nominal, p[:SIZE])
        at = pose(geometry, theta + p[:2])
        jacobian = np.zeros((len(target), 2, len(self.parameters)))
        jacobian[:, :, :SIZE] = position_jacobian(geometry, at)
        error = at.r - target
        return np.column_stack([error.real, error.imag]), jacobian


def lengths(robot: Robot) -> dict[str, float]:
    """Nominal lengths by parameter name, mm."""
    return {"L1": robot.L[0], "L2": robot.L[1], "l1": robot.l[0], "l2": robot.l[1]}


def load(theta: Real) -> tuple[Real, ...]:
    """(K, 1) per joint: gravity's moment on its proximal link, 1 when horizontal."""
    return tuple(np.cos(theta[:, [i]]) for i in range(theta.shape[1]))


def pull(w: Complex) -> Real:
    """(K, 2) +1 where gravity pulls a distal link, -1 where it pushes: w_1 f_1 + w_2 f_2 = (0, -1)."""
    both = np.stack([w.real, w.imag], axis=1)
    down = np.tile([0.0, -1.0], (len(w), 1))
    return np.asarray(np.sign(np.linalg.solve(both, down[:, :, None])[:, :, 0]))
