"""Robot descriptions: the same arm as Denavit-Hartenberg links."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.spatial.transform import Rotation

from station.cli import main
from station.errors import InputRefused
from station.machines import read_robot
from station.records import Real
from station.serial_arm import Arm, arm_from_urdf
from station.serial_arm.dh import reach

UR5_MM = {"d1": 89.159, "a2": 425.0, "a3": 392.25, "d4": 109.15, "d5": 94.65, "d6": 82.3}


def urdf(*joints: str) -> bytes:
    return f'<?xml version="1.0"?><robot name="r">{"".join(joints)}</robot>'.encode()


def joint(
    k: int,
    kind: str = "revolute",
    xyz: Any = (0, 0, 0),
    rpy: Any = (0, 0, 0),
    axis: Any = (0, 0, 1),
) -> str:
    place = " ".join(f"{v:.12g}" for v in xyz)
    turn = " ".join(f"{v:.12g}" for v in rpy)
    about = " ".join(f"{v:.12g}" for v in axis)
    return (
        f'<joint name="j{k}" type="{kind}"><origin xyz="{place}" rpy="{turn}"/><axis xyz="{about}"/>'
        f'<parent link="l{k}"/><child link="l{k + 1}"/></joint>'
    )


def moved(arm: Arm, theta: Real) -> Real:
    """(K, 3) where the target stands in the frame of the arm's base."""
    return reach(arm.links, np.zeros((arm.joints, 6)), np.array(arm.tool_mm), theta).end


def distances(points: Real) -> Real:
    return np.asarray(np.linalg.norm(points[:, None] - points[None, :], axis=2))


@pytest.mark.parametrize("seed", range(12))
def test_any_chain_moves_its_tool_alike(seed: int) -> None:
    """Axes askew, parallel, crossing or in one line, joints that turn or slide: the tool moves as the

    description's own frames say.
    """
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 8))
    chain = []
    for _ in range(count):
        rpy = rng.choice([0.0, np.pi / 2, -np.pi / 2, rng.uniform(-3, 3)], 3)
        xyz = rng.choice([0.0, 0.0, rng.uniform(-0.6, 0.6)], 3)
        axis = (
            rng.normal(size=3) if rng.random() < 0.3 else rng.choice([-1.0, 1.0]) * np.eye(3)[rng.integers(3)]
        )
        chain.append((xyz, rpy, axis))
    kinds = rng.choice(["revolute", "continuous", "prismatic"], count, p=[0.6, 0.2, 0.2])
    tip = rng.uniform(-0.2, 0.2, 3)
    text = urdf(*(joint(k, kinds[k], *each) for k, each in enumerate(chain)), joint(count, "fixed", tip))
    arm = arm_from_urdf(text, "r.urdf", "l0", f"l{count + 1}", "R")
    theta = rng.uniform(-3, 3, (20, count))
    at = []
    for pose in theta:
        origin, frame = np.zeros(3), np.eye(3)
        for (xyz, rpy, axis), kind, way in zip(chain, kinds, pose, strict=True):
            origin, frame = origin + 1000.0 * frame @ xyz, frame @ Rotation.from_euler("xyz", rpy).as_matrix()
            along = way * axis / np.linalg.norm(axis)
            if kind == "prismatic":
                origin = origin + 1000.0 * frame @ along
            else:
                frame = frame @ Rotation.from_rotvec(along).as_matrix()
        at.append(origin + 1000.0 * frame @ tip)
    assert distances(moved(arm, theta)) == pytest.approx(distances(np.array(at)), abs=1e-3)


def test_a_known_arm_has_the_links_of_its_maker(tmp_path: Path) -> None:
    s = {name: mm / 1000.0 for name, mm in UR5_MM.items()}
    half = np.pi / 2
    file = tmp_path / "ur5.urdf"
    file.write_bytes(
        urdf(
            joint(0, xyz=(0, 0, s["d1"])),
            joint(1, rpy=(half, 0, 0)),
            joint(2, xyz=(-s["a2"], 0, 0)),
            joint(3, "continuous", xyz=(-s["a3"], 0, s["d4"])),
            joint(4, xyz=(0, -s["d5"], 0), rpy=(half, 0, 0)),
            joint(5, xyz=(0, s["d6"], 0), rpy=(-half, 0, 0)),
        )
    )
    made = CliRunner().invoke(main, ["robot", "--urdf", str(file), "--base", "l0", "--tool", "l6"])
    assert made.exit_code == 0, made.output
    (tmp_path / "ur5.toml").write_text(made.stdout)
    arm = read_robot(tmp_path / "ur5.toml")
    assert isinstance(arm, Arm) and arm.serial == "ur5"
    assert sorted(abs(v) for v in arm.a) == pytest.approx([0, 0, 0, 0, 392.25, 425.0], abs=1e-6)
    assert abs(arm.d[0]) == pytest.approx(89.159)
    assert arm.gravity == pytest.approx((0, 0, -1))


@pytest.mark.parametrize(
    ("content", "links", "text"),
    [
        (b"not xml", ("a", "b"), "is not XML"),
        (b"<robot xmlns:xacro='x'><a>", ("a", "b"), "Expand the xacro file first"),
        (b"<!DOCTYPE robot [<!ENTITY e 'e'>]><robot/>", ("a", "b"), "remove it"),
        (b"<sdf/>", ("a", "b"), "a URDF file has <robot>"),
        (urdf(joint(0), joint(1)), ("l0", "hand"), "no joined link 'hand'; it has l0, l1, l2"),
        (urdf(joint(0), joint(1)), ("l2", "l0"), "does not follow link l2"),
        (urdf(joint(0), joint(1, "floating")), ("l0", "l2"), "joint j1 is floating"),
        (urdf(joint(0), joint(1, "fixed")), ("l0", "l2"), "1 joints that move; two are needed"),
        (urdf(joint(0), joint(1, axis=(0, 0, 0))), ("l0", "l2"), "has no direction"),
        (urdf(joint(0)).replace(b'xyz="0 0 0"', b'xyz="0 0"'), ("l0", "l1"), "three numbers are needed"),
        (urdf(joint(0)).replace(b'<parent link="l0"/>', b""), ("l0", "l1"), "lacks <parent> or <child>"),
    ],
    ids=lambda v: v[:24] if isinstance(v, str) else None,
)
def test_a_refusal_says_what_to_do(content: bytes, links: tuple[str, str], text: str) -> None:
    with pytest.raises(InputRefused, match=text.replace("(", r"\(")):
        arm_from_urdf(content, "r.urdf", *links, "R")
