"""`station apply`, `station rollback`, `station retract`: what moves the machine without a plan."""

from __future__ import annotations

import getpass
from pathlib import Path

import click

from station.cli.kept import run_argument
from station.cli.machine_options import machine_options, read_settings
from station.cli.one_run import one_run

_operator = click.option("--operator", help="Who is responsible; else the user of this terminal.")


@click.command("apply")
@run_argument
@_operator
@machine_options
@click.pass_obj
def apply_command(
    home: Path,
    calibration_id: int,
    operator: str | None,
    config: Path | None,
    emulate: Path | None,
    speed: float | None,
) -> None:
    """Write the zero offsets of a passed run to the drives and verify them."""
    who = operator or getpass.getuser()
    settings = read_settings(config, speed)
    one_run(
        home, settings, emulate, lambda runtime: runtime.orchestrator.follow("apply", calibration_id, who)
    )


@click.command("rollback")
@run_argument
@_operator
@machine_options
@click.pass_obj
def rollback_command(
    home: Path,
    calibration_id: int,
    operator: str | None,
    config: Path | None,
    emulate: Path | None,
    speed: float | None,
) -> None:
    """Put the zeros back that the drives had before a run was applied."""
    who = operator or getpass.getuser()
    settings = read_settings(config, speed)
    one_run(
        home, settings, emulate, lambda runtime: runtime.orchestrator.follow("rollback", calibration_id, who)
    )


@click.command("retract")
@_operator
@machine_options
@click.pass_obj
def retract_command(
    home: Path, operator: str | None, config: Path | None, emulate: Path | None, speed: float | None
) -> None:
    """Bring the arm back into its workspace, slowly."""
    who = operator or getpass.getuser()
    settings = read_settings(config, speed)
    one_run(home, settings, emulate, lambda runtime: runtime.orchestrator.retract(who))
