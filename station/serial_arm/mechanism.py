"""A serial arm as a mechanism: joint angles in, tracker positions or distances out, with derivatives.

Position of the target: s_k = t + R p(theta_k + dtheta; links, tool).  Distance from the instrument's origin,
at o in the base frame: s_k = |p(theta_k + dtheta; links, tool) - o|.  Base pose and tool point belong to the
fit; their start values come from the readings.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np

from station.errors import InputRefused
from station.fitting import NotConvergedError, Prior, solve
from station.mechanism import Conditions, Observation, Parameter, Reference, temperature_rise
from station.records import MOTIONS, TIME, Complex, Index, Measurements, Motion, Real
from station.serial_arm.dh import LINK_ERRORS, MM, Reach, reach
from station.serial_arm.placement import DEGREES, Placement
from station.serial_arm.robot_file import ARM_MODEL, Arm
from station.serial_arm.suspected import wrong_entry

METRES = 0.02
"""Maximum length of an arm, in metres, that contains every target."""
MISFIT = 0.03
"""Misfit over the arm's length beyond which angles and positions belong to different machines."""
UNKNOWN_ENTRY = (
    "; check the robot file (a_mm, d_mm, alpha_deg, offset_deg, convention), the unit of the readings, and "
    "sign and order of the joints."
)
_OTHERS = LINK_ERRORS[1:]
"""Errors of a link beside the zero offset of its joint; for a sliding joint the zero is along z,"""
_OTHERS_SLIDING = ("theta", *LINK_ERRORS[2:])
"""and the error about z is listed here."""


class SerialArm:
    """Parameters: zero offsets of the n joints, five more errors per link, tool points, poses of the base.

    With distances only, the pose of the base is the instrument's origin (three numbers): turning the whole
    arm about that origin changes no distance.
    """

    model = ARM_MODEL
    needs_repeats = False
    workspace: Complex = np.zeros(0, dtype=complex)
    """No workspace is declared: an arm is evaluated at its measured poses."""

    def __init__(self, robot: Arm, measurements: Measurements, frame: Real | None = None) -> None:
        """`frame` (S, 3, 3): reference orientations of the base; computed if omitted."""
        self.robot = robot
        self.measurements = measurements
        self.theta = measurements.theta
        self.by_range = measurements.tracker is None
        self._links = robot.links
        self._placement = Placement(measurements, by_range=self.by_range)
        self._frame = frame
        if measurements.tracker is None:
            self.measured: Real = measurements.distance
            self.reading_of_row: Index = np.arange(len(measurements))
        else:
            self.measured = measurements.tracker.ravel()
            self.reading_of_row = np.repeat(np.arange(len(measurements)), 3)

    @cached_property
    def parameters(self) -> tuple[Parameter, ...]:
        """The unknowns with the priors of the robot file."""
        n, t = self.robot.joints, self.robot.tolerances
        angle = ("deg", 0.0, np.radians(t.angle_deg), DEGREES)
        length = ("mm", 0.0, t.length_mm)
        turning = ("deg", 0.0, np.radians(t.zero_offset_deg), DEGREES)
        sliding = ("mm", 0.0, t.length_mm / MM, MM)
        slides = self._links.sliding
        out = [
            Parameter(f"dtheta{i + 1}", "zero_offset", *(sliding if i in slides else turning))
            for i in range(n)
        ]
        for i in range(n):
            out += [
                Parameter(f"{name}{i + 1}", "geometry", *(length if name in ("d", "a", "b") else angle))
                for name in (_OTHERS_SLIDING if i in slides else _OTHERS)
            ]
        return (*out, *self._placement.parameters(self.robot.tool_sd_mm))

    @cached_property
    def row_sd(self) -> Real:
        """(R,) standard deviation from the instrument's and the arm's own repeatability."""
        return np.full(len(self.measured), self.robot.reading_sd_mm)

    @cached_property
    def start(self) -> Real:
        """(P,) nominal links; the base from the readings: by Kabsch's rotation, or by trilateration.

        :raises InputRefused: no pose of the base matches angles and readings.
        """
        p = np.array([q.prior_mean for q in self.parameters])
        at = self._reach(p, self.theta).end
        setups = self._placement.setups(p[self._links_size :])  # a view: values set here are set in p
        for s, rows in enumerate(self._placement.rows):
            if not len(rows):
                continue  # fresh readings: the set-up was placed from those learned from
            if self.by_range:
                setups[s] = _trilaterated(at[rows], self.measured[rows])
            else:
                seen = self.measured.reshape(-1, 3)[rows].mean(axis=0)
                setups[s, :3] = seen - self._base_frame[s] @ at[rows].mean(axis=0)
        return p

    @property
    def simplest(self) -> tuple[str, tuple[str, ...]]:
        """Nominal links: only tool point and base are unknown."""
        return "nominal", tuple(p.name for p in self.parameters if p.role == "placement")

    def of(self, measurements: Measurements) -> SerialArm:
        """The same arm with other readings, its base unchanged."""
        return SerialArm(self.robot, measurements, None if self.by_range else self._base_frame)

    def check(self) -> None:
        """:raises InputRefused: readings are impossible for this arm."""
        m = self.measurements
        self._placement.check()
        turning = [i for i in range(m.joints) if i not in self._links.sliding]
        if np.abs(np.degrees(m.theta[:, turning])).max(initial=0.0) < 2.0 * np.pi and turning:
            raise InputRefused(
                f"Reading {m.ids[0]}, columns theta1_deg to theta{m.joints}_deg: "
                "the angles look like radians; give degrees, or their unit in a column map "
                "(`station columns` proposes one, for `--columns`)."
            )
        off, size = self._nominal_misfit(), self._length
        furthest = float(np.abs(self.measured).max())
        if furthest < METRES * size:
            raise InputRefused(
                f"No reading is further off than {furthest:.3g} mm, of an arm of {size:.0f} mm: positions "
                "and distances look like metres; give millimetres, or their unit in a column map "
                "(`station columns` proposes one, for `--columns`)."
            )
        if not off < MISFIT * size:
            entry = wrong_entry(self.robot, m, off, lambda arm, read: SerialArm(arm, read)._nominal_misfit())
            raise InputRefused(
                f"Angles and readings do not belong together: half of the readings are {off:.0f} mm or more "
                f"off an arm of {size:.0f} mm{entry or UNKNOWN_ENTRY}"
            )

    def _nominal_misfit(self) -> float:
        """Median misfit of the rows, mm, with nominal links and the best base and tool."""
        start = self.start
        free = np.flatnonzero([p.name in self.simplest[1] for p in self.parameters])

        def residuals(q: Real) -> tuple[Real, Real]:
            p = start.copy()
            p[free] = q
            at = self.observe(p, self.theta)
            return at.value - self.measured, at.by_parameter[:, free]

        try:
            left = solve(residuals, start[free], Prior(start[free], np.zeros((0, len(free))))).residual
        except NotConvergedError:
            left = residuals(start[free])[0]
        return float(np.median(np.abs(left)))

    def observe(self, p: Real, theta: Real) -> Observation:
        """(R,) positions or distances with derivatives."""
        at = self._reach(p, theta)
        n, place = self.robot.joints, self._placement
        count = len(theta)
        others = at.by_link[:, :, :, 1:]
        if self._links.sliding:
            others = others.copy()
            others[:, :, self._links.sliding, 0] = at.by_link[:, :, self._links.sliding, 0]
        own = np.concatenate([at.by_joint, others.reshape(count, 3, -1), place.of_points(at.by_tool)], axis=2)
        setups = place.setups(p[self._links_size :])
        if self.by_range:
            lam = at.end - setups[place.setup]
            rho = np.linalg.norm(lam, axis=1)
            along = lam / rho[:, None]
            by_parameter = np.hstack([np.einsum("ki,kip->kp", along, own), place.of_setups(-along)])
            return Observation(rho, by_parameter, by_parameter[:, :n], self._motions)
        arm, by_setup = np.empty((count, 3)), np.empty((count, 3, 6))
        by_setup[:, :, :3] = np.eye(3)
        for s, rows in enumerate(place.rows):
            frame, axes = self._turned(s, setups[s, 3:])
            own[rows] = np.einsum("ij,kjp->kip", frame, own[rows])
            arm[rows] = at.end[rows] @ frame.T
            by_setup[rows, :, 3:] = np.stack([np.cross(axis, arm[rows]) for axis in axes], axis=2)
        by_parameter = np.concatenate([own, place.of_setups(by_setup)], axis=2).reshape(3 * count, -1)
        seen = setups[place.setup, :3] + arm
        return Observation(seen.ravel(), by_parameter, by_parameter[:, :n], self._motions)

    @cached_property
    def _motions(self) -> dict[Motion, Real]:
        """(R, n) of each kind, at the reading of each row."""
        return {kind: self.measurements.motion(kind)[self.reading_of_row] for kind in MOTIONS}

    def conditions(self, p: Real, reference: Reference, *, first: bool) -> Conditions:
        """The conditions of the readings; there is no slider, and `first` makes no difference."""
        m = self.measurements
        theta = m.theta + p[: self.robot.joints]
        unknown = np.zeros(len(m))
        links = self._links
        lengths = {f"a{i + 1}": a for i, a in enumerate(links.a)} | {
            f"d{i + 1}": d for i, d in enumerate(links.d)
        }
        return Conditions(
            t_s=m.numbers if TIME in m.guessed and m.numbers.any() else m.t_s,
            theta=theta,
            drive_angle=m.theta,
            approach=m.approach.astype(float),
            travel=self.observe(p, m.theta).value if self.by_range else unknown,
            slider_direction=unknown,
            slider_by_joint=np.zeros_like(theta),
            slider_net=unknown,
            temperature_rise=temperature_rise(m, reference),
            payload_kg=m.payload_kg,
            lengths={name: float(mm) for name, mm in lengths.items() if mm},
            pull=np.zeros_like(theta),
            load=self._load(theta),
            step=m.motion("step"),
            speed=m.motion("speed"),
        )

    def implausible(self, p: Real) -> str:
        """No parameters are implausible: tool and base may be anywhere."""
        return ""

    def position_errors(self, p: Real) -> None:
        """None: there is no workspace to predict them over."""
        return

    def places(self, p: Real) -> Real:
        """(K, 3) position of the target in the frame of the base, mm."""
        return self._reach(p, self.theta).end

    @property
    def _length(self) -> float:
        return float(np.sum(np.abs(self._links.a)) + np.sum(np.abs(self._links.d)))

    @property
    def _links_size(self) -> int:
        """Number of unknowns before those of the placement."""
        return 6 * self.robot.joints

    def _reach(self, p: Real, theta: Real) -> Reach:
        n = self.robot.joints
        errors = np.column_stack([p[:n], p[n : 6 * n].reshape(n, 5)])
        for i in self._links.sliding:
            errors[i, :2] = errors[i, 1], MM * errors[i, 0]
        tool = np.array(self.robot.tool_mm) + self._placement.tool(p[self._links_size :])
        return reach(self._links, errors, tool, theta)

    @cached_property
    def _nominal_reach(self) -> Reach:
        return self._reach(np.zeros(len(self.parameters)), self.theta)

    @cached_property
    def _base_frame(self) -> Real:
        """(S, 3, 3) orientations of the base, as far as they are visible with an unknown tool point."""
        if self._frame is not None:
            return self._frame
        from scipy.spatial.transform import Rotation  # imported here, because a five-bar never needs it

        frames = np.tile(np.eye(3), (len(self._placement.rows), 1, 1))
        for s, rows in enumerate(self._placement.rows):
            if len(rows):
                at, seen = self._nominal_reach.end[rows], self.measured.reshape(-1, 3)[rows]
                turn, _ = Rotation.align_vectors(seen - seen.mean(axis=0), at - at.mean(axis=0))
                frames[s] = turn.as_matrix()
        return frames

    def _turned(self, setup: int, turns: Real) -> tuple[Real, list[Real]]:
        """Base orientation Rx Ry Rz R_0 at rotations (3,), rad, and the axis of each of the three."""
        from scipy.spatial.transform import Rotation

        x, y, z = (Rotation.from_euler(axis, turns[k]).as_matrix() for k, axis in enumerate("xyz"))
        return x @ y @ z @ self._base_frame[setup], [np.eye(3)[0], x[:, 1], (x @ y)[:, 2]]

    def _load(self, theta: Real) -> tuple[Real, ...]:
        """(K, q) per joint: moment of a unit weight at each origin beyond it, 1 at the arm's full length."""
        at = self._reach(np.zeros(len(self.parameters)), theta)
        down = np.array(self.robot.gravity) / np.linalg.norm(self.robot.gravity)
        out = []
        for i in range(self.robot.joints):
            beyond = np.concatenate([at.origins[:, i + 1 :], at.end[:, None]], axis=1) - at.pivots[:, [i]]
            moment = np.einsum("kj,kqj->kq", at.axes[:, i], np.cross(beyond, down))
            out.append(moment / self._length)
        return tuple(out)


def _trilaterated(at: Real, distance: Real) -> Real:
    """(3,) the point that is at distances (K,) from positions (K, 3): |a|^2 - d^2 = 2 a.o - |o|^2."""
    centre = at.mean(axis=0)
    a = at - centre
    rows = np.column_stack([2.0 * a, -np.ones(len(a))])
    return np.asarray(np.linalg.lstsq(rows, np.sum(a * a, axis=1) - distance**2, rcond=None)[0][:3] + centre)
