"""The robot file: Table 1 by default, refusals with section and key."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from station.errors import InputRefused
from station.five_bar.robot_file import Robot
from station.records import MountingError


def test_without_a_file_it_is_table_1() -> None:
    robot = Robot.default()
    assert robot.geometry.e == pytest.approx([80, -80])
    assert [*robot.L, *robot.l] == pytest.approx([375, 375, 825, 825])
    assert robot.geometry.cd == pytest.approx(-130j)
    assert robot.pulse_deg == pytest.approx(0.0018)


@pytest.mark.parametrize(
    "robot",
    [
        Robot.default("R1"),
        Robot.default("R1").with_mechanism((0.9, 0.4), (0.02, 0.02)),
        replace(Robot.default("R2"), type="DR-2", accuracy_mm=0.2, feedback_sd_deg=0.001, ratio=25.0),
        replace(Robot.default("R3"), feedback_sd_deg=0.0, mounts={"left": (-80.0, -79.0)}, sign=(1, -1)),
        Robot.default("R4").informed([MountingError(kind="drm_x", value_mm=1.02, sd_mm=0.02)]),
    ],
)
def test_a_robot_survives_the_way_to_json_and_back(robot: Robot) -> None:
    """A run would otherwise be judged otherwise when it is computed again from the history."""
    assert Robot.from_dict(robot.to_json()) == robot


def test_a_file_that_states_the_default_feedback_as_earlier_versions_stored_it_leaves_it_open() -> None:
    sections = Robot.default("R1").to_json()
    stored = Robot.from_dict(
        {**sections, "joints": {**sections["joints"], "feedback_sd_deg": 0.0018 / 12**0.5}}
    )
    assert stored == Robot.default("R1")


def test_a_file_is_read(tmp_path: Path) -> None:
    file = tmp_path / "robot.toml"
    file.write_text(
        '[robot]\nserial = "R7"\nL = 380\n[robot.tolerance]\nlink_mm = 0.003\n'
        "[mechanism]\ndrm_mm = [0.8, 0.4]\ndrm_sd_mm = 0.02\n[joints]\nratio = 25\nsign = [1, -1]\n"
    )
    robot = Robot.from_toml(file)
    assert (robot.serial, robot.L, robot.tolerances.link_mm) == ("R7", (380, 380), 0.003)
    assert robot.drm_sd == (0.02, 0.02)
    assert robot.scaling(2).sign == -1
    assert robot.scaling(2).to_pulses(179.0) == round(10_000 * 25 / 360)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("[robot]\nL = -3\n", "robot.L"),
        ("[robot]\nlength = 3\n", "robot.length"),
        ("[robot]\nL = 'x'\n", "robot.L"),
        ("[mechanism]\ndrm_sd_mm = 0\n", "mechanism.drm_sd_mm"),
        ("[workspace]\nx = [240, -240]\n", "workspace.x"),
        ("[workspace]\ny = [-2000, -632]\n", "cannot reach"),
        ("[joints]\ncounts_per_rev = 0\n", "joints.counts_per_rev"),
        ("[robot\n", "not valid TOML"),
        ("[robot]\nL = nan\n", "robot.L"),
    ],
)
def test_refusals_name_the_place(text: str, expected: str, tmp_path: Path) -> None:
    file = tmp_path / "robot.toml"
    file.write_text(text)
    with pytest.raises(InputRefused) as refusal:
        Robot.from_toml(file)
    assert expected in str(refusal.value)
    assert "\n" not in str(refusal.value)


def test_a_missing_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputRefused, match="cannot be read"):
        Robot.from_toml(tmp_path / "none.toml")
