"""`station doctor`: faults of ports, lines and devices, with their remedies."""

from __future__ import annotations

import logging
from pathlib import Path

import click
from rich.console import Console
from rich.text import Text
from rich.tree import Tree

from station.cli.machine_options import Machine, logging_to, machine_options
from station.doctor import Condition, Finding, examine
from station.five_bar import Robot
from station.motion import equipment
from station.service import holding
from station.settings import database_path
from station.store import Store

_MARKS: dict[Condition, tuple[str, str]] = {
    "ok": ("ok", "green"),
    "note": ("note", "yellow"),
    "trouble": ("trouble", "bold red"),
}


@click.command("doctor")
@machine_options
@click.pass_obj
def doctor_command(home: Path, machine: Machine) -> None:
    """Examine every device and its line without motion, and list remedies.

    Exit status 1: at least one device does not work.
    """
    settings = machine.settings
    robot = _robot_measured_last(database_path(settings, home))
    rig = equipment(settings, home, machine.emulate)
    with holding(home), logging_to(home, terminal=logging.ERROR), rig as found:
        tree = examine(found.settings, found.devices, robot)
    Console(highlight=False).print(_drawn(tree))
    if not tree.healthy:
        raise SystemExit(1)


def _robot_measured_last(database: Path) -> Robot:
    if not database.exists():
        return Robot.default()
    store = Store(database, read_only=True)
    try:
        last = store.last_on_rig()
        return Robot.default() if last is None else store.robot_or_nominal(last.robot_serial)
    finally:
        store.close()


def _drawn(finding: Finding) -> Tree:
    tree = Tree(_line(finding))
    for part in finding.parts:
        tree.children.append(_drawn(part))
    return tree


def _line(finding: Finding) -> Text:
    if finding.parts and finding.condition == "ok":
        return Text(finding.text)
    mark, style = _MARKS[finding.condition]
    line = Text.assemble((mark, style), f"  {finding.text}")
    return line.append(f"\n→ {finding.do}", "bold") if finding.do else line
