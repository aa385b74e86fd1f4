"""`station robot`: a robot file from the description that other software has of an arm."""

from __future__ import annotations

from pathlib import Path

import click

from station.cli.files import file_path
from station.records import content_of, sections_to_toml
from station.serial_arm import arm_from_urdf


@click.command("robot")
@click.option("--urdf", required=True, type=file_path, help="The robot description.")
@click.option("--base", required=True, help="Link that stands still.")
@click.option("--tool", required=True, help="Link whose origin is measured.")
@click.option("--serial", help="Serial number of the robot; the name of the file without it.")
def robot_command(urdf: Path, base: str, tool: str, serial: str | None) -> None:
    """Write the robot file of an arm from its URDF description: `station robot ... > robot.toml`."""
    arm = arm_from_urdf(content_of(urdf), str(urdf), base, tool, serial or urdf.stem)
    click.echo(sections_to_toml(arm.to_json()), nl=False)
