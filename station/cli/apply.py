"""`station apply`, `station rollback`, `station retract`: what moves the machine without a plan."""

from __future__ import annotations

from pathlib import Path

import click

from station.cli.kept import run_argument
from station.cli.machine_options import Machine, machine_options
from station.cli.one_run import one_run, operator_option


@click.command("apply")
@run_argument
@operator_option
@machine_options
@click.pass_obj
def apply_command(home: Path, calibration_id: int, operator: str, machine: Machine) -> None:
    """Write the zero offsets of a passed run to the drives and verify them."""
    one_run(home, machine, lambda runtime: runtime.orchestrator.follow("apply", calibration_id, operator))


@click.command("rollback")
@run_argument
@operator_option
@machine_options
@click.pass_obj
def rollback_command(home: Path, calibration_id: int, operator: str, machine: Machine) -> None:
    """Restore the zeros that the drives had before a run was applied."""
    one_run(home, machine, lambda runtime: runtime.orchestrator.follow("rollback", calibration_id, operator))


@click.command("retract")
@operator_option
@machine_options
@click.pass_obj
def retract_command(home: Path, operator: str, machine: Machine) -> None:
    """Bring the arm back into its workspace, slowly."""
    one_run(home, machine, lambda runtime: runtime.orchestrator.retract(operator))
