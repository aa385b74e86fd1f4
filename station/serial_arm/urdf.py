"""A robot description (URDF) as Denavit-Hartenberg links.

Only the joint axes are used: with the arm at its zeros each is a line in space, and two neighbouring lines
have a common normal. Its length is a, the rotation about it alpha; d and the joint's offset are the distance
and the angle between two normals, along and about the line (Denavit and Hartenberg 1955, standard form).
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple
from xml.etree import ElementTree

import numpy as np

from station.errors import InputRefused
from station.records import Real
from station.serial_arm.robot_file import Arm, JointKind

PARALLEL = 1e-6
"""Sine of the angle between two axes below which they count as parallel,"""
SAME_MM = 1e-6
"""and distance below which they are one line."""
MM = 1000.0
KINDS: dict[str, JointKind] = {
    "revolute": "revolute",
    "continuous": "revolute",
    "prismatic": "prismatic",
}
"""Names of the moving joints in a robot file."""


class _Line(NamedTuple):
    """A joint axis at the arm's zeros, in the frame of the base."""

    point: Real
    along: Real
    """(3,) unit vector; the joint rotates about it or slides along it."""
    kind: JointKind


@dataclass(frozen=True)
class _Joint:
    name: str
    kind: str
    parent: str
    child: str
    shift: Real
    """(3,) mm, origin of its frame in the parent's."""
    turn: Real
    """(3, 3)"""
    axis: Real
    """(3,) in its own frame."""


def arm_from_urdf(content: bytes, source: str, base: str, tool: str, serial: str) -> Arm:
    """The arm between two links; the target sits at the origin of the link `tool`.

    :raises InputRefused: the file is not a robot description, there is no such link, the links are not
    connected, or a joint between them neither rotates nor slides.
    """
    joints = _joints(content, source)
    lines: list[_Line] = []
    origin, frame = np.zeros(3), np.eye(3)
    for joint in _way(joints, source, base, tool):
        origin = origin + frame @ joint.shift
        frame = frame @ joint.turn
        if joint.kind in KINDS:
            lines.append(_Line(origin, frame @ joint.axis, KINDS[joint.kind]))
        elif joint.kind != "fixed":
            raise InputRefused(
                f"{source}: joint {joint.name} is {joint.kind}; only joints that turn or slide can be "
                "calibrated. Choose `--base` and `--tool` so that it is not between them."
            )
    if len(lines) < 2:
        raise InputRefused(
            f"{source}: between {base} and {tool} there are {len(lines)} joints that move; two are needed."
        )
    return _arm(lines, origin, serial)


def _joints(content: bytes, source: str) -> dict[str, _Joint]:
    """Joints by child link."""
    if b"<!DOCTYPE" in content or b"<!ENTITY" in content:
        raise InputRefused(f"{source}: a robot description has no DOCTYPE; remove it.")
    try:
        robot = ElementTree.fromstring(content)  # noqa: S314 - no entities come this far
    except ElementTree.ParseError as error:
        hint = " Expand the xacro file first." if b"xacro" in content else ""
        raise InputRefused(f"{source} is not XML: {error}.{hint}") from error
    if robot.tag != "robot":
        raise InputRefused(f"{source}: the outermost element is <{robot.tag}>; a URDF file has <robot>.")
    out: dict[str, _Joint] = {}
    for element in robot.iterfind("joint"):
        name = element.get("name", "unnamed")
        parent, child = (element.find(side) for side in ("parent", "child"))
        if parent is None or child is None:
            raise InputRefused(f"{source}: joint {name} lacks <parent> or <child>.")
        at, axis = element.find("origin"), element.find("axis")
        joint = _Joint(
            name,
            element.get("type", ""),
            parent.get("link", ""),
            child.get("link", ""),
            MM * _triple(at, "xyz", (0.0, 0.0, 0.0), source, name),
            _turned(_triple(at, "rpy", (0.0, 0.0, 0.0), source, name)),
            _unit(_triple(axis, "xyz", (1.0, 0.0, 0.0), source, name), source, name),
        )
        out[joint.child] = joint
    return out


def _triple(
    element: ElementTree.Element | None, key: str, default: tuple[float, float, float], source: str, name: str
) -> Real:
    text = None if element is None else element.get(key)
    if text is None:
        return np.array(default)
    try:
        values = np.array([float(word) for word in text.split()])
    except ValueError:
        values = np.array([])
    if len(values) != 3 or not np.isfinite(values).all():
        raise InputRefused(f'{source}: joint {name} has {key}="{text}"; three numbers are needed.')
    return values


def _unit(axis: Real, source: str, name: str) -> Real:
    length = float(np.linalg.norm(axis))
    if length == 0.0:
        raise InputRefused(f"{source}: the axis of joint {name} has no direction.")
    return axis / length


def _turned(rpy: Real) -> Real:
    """(3, 3) rotation about the fixed axes x, y, z in this order."""
    (a, b, c), (sa, sb, sc) = np.cos(rpy), np.sin(rpy)
    x = np.array([[1.0, 0.0, 0.0], [0.0, a, -sa], [0.0, sa, a]])
    y = np.array([[b, 0.0, sb], [0.0, 1.0, 0.0], [-sb, 0.0, b]])
    z = np.array([[c, -sc, 0.0], [sc, c, 0.0], [0.0, 0.0, 1.0]])
    return np.asarray(z @ y @ x)


def _way(joints: dict[str, _Joint], source: str, base: str, tool: str) -> list[_Joint]:
    """The joints from the link `base` to the link `tool`, in this order."""
    links = sorted({*joints, *(joint.parent for joint in joints.values())})
    for name in (base, tool):
        if name not in links:
            raise InputRefused(f"{source} has no joined link {name!r}; it has {', '.join(links)}.")
    out: list[_Joint] = []
    link = tool
    while link != base:
        if link not in joints or joints[link] in out:
            raise InputRefused(f"{source}: link {tool} does not follow link {base} along its joints.")
        out.append(joints[link])
        link = joints[link].parent
    return out[::-1]


def _arm(lines: list[_Line], tip: Real, serial: str) -> Arm:
    """Standard links along the common normals; the base's z-axis is the first joint's."""
    z = lines[0].along
    origin: Real = lines[0].point - (lines[0].point @ z) * z
    x = _across(z)
    base = np.column_stack([x, np.cross(z, x), z])
    a, d, alpha, offset = [], [], [], []
    for line, following in pairwise(lines):
        foot, normal, foot_there = _common_normal(line, following, origin, x)
        offset.append(_angle(x, normal, line.along))
        d.append(float((foot - origin) @ line.along))
        a.append(float((foot_there - foot) @ normal))
        alpha.append(_angle(line.along, following.along, normal))
        origin, x = foot_there, normal
    a, d, alpha, offset = [*a, 0.0], [*d, 0.0], [*alpha, 0.0], [*offset, 0.0]
    last = lines[-1].along
    flange = np.column_stack([x, np.cross(last, x), last])
    target = flange.T @ (tip - origin)
    down = base.T @ np.array([0.0, 0.0, -1.0])
    return Arm(
        serial=serial,
        a=_rounded(a),
        d=_rounded(d),
        alpha_deg=_rounded(np.degrees(alpha)),
        offset_deg=_rounded(np.degrees(offset)),
        joint_kinds=tuple(line.kind for line in lines),
        tool_mm=(float(np.round(target[0], 6)), float(np.round(target[1], 6)), float(np.round(target[2], 6))),
        gravity=(float(np.round(down[0], 9)), float(np.round(down[1], 9)), float(np.round(down[2], 9))),
    )


def _common_normal(line: _Line, following: _Line, origin: Real, x: Real) -> tuple[Real, Real, Real]:
    """Foot on the line, unit direction, foot on the following line."""
    across = np.cross(line.along, following.along)
    apart = following.point - line.point
    if np.linalg.norm(across) > PARALLEL:
        normal = across / np.linalg.norm(across)
        # apart = s along - t along' + gap normal
        s, t, gap = np.linalg.solve(np.column_stack([line.along, -following.along, normal]), apart)
        normal = -normal if gap < -SAME_MM else normal
        return line.point + s * line.along, normal, following.point + t * following.along
    # parallel lines have many common normals: the one through the end of the last link has d = 0
    there = following.point + ((origin - following.point) @ following.along) * following.along
    gap_vector = there - origin
    gap = float(np.linalg.norm(gap_vector))
    return origin, (gap_vector / gap if gap > SAME_MM else x), there


def _across(z: Real) -> Real:
    """(3,) the base's x-axis, as far as z permits."""
    x = np.array([1.0, 0.0, 0.0]) if abs(z[0]) < 0.9 else np.array([0.0, 1.0, 0.0])
    x = x - (x @ z) * z
    return np.asarray(x / np.linalg.norm(x))


def _angle(first: Real, second: Real, about: Real) -> float:
    """Angle from one direction to another about an axis, rad."""
    return float(np.arctan2(np.cross(first, second) @ about, first @ second))


def _rounded(values: list[float] | Real) -> tuple[float, ...]:
    return tuple(float(v) + 0.0 for v in np.round(values, 6))
