"""`station identify` and `station plan`: numbers without a machine."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any, get_args

import click
from rich.console import Console
from rich.table import Table

from station.five_bar import Robot
from station.identification import ArmIdentification, Identification, identify, identify_arm
from station.machines import Measured, read_readings, read_robot
from station.plans import make_plan, plan_as_text, plan_page
from station.records import PlanName, Quantity
from station.serial_arm import Arm

existing = click.Path(path_type=Path)
measured_option = click.option(
    "--measured",
    type=click.Choice(get_args(Measured)),
    default="position",
    show_default=True,
    help="What counts of an arm's log that has both.",
)


@click.command("identify")
@click.argument("data", type=existing)
@click.option("--robot", "robot_file", type=existing, help="Robot file; without it the paper's Table 1.")
@measured_option
@click.option("--json", "json_file", type=existing, help="Write the whole result here.")
def identify_command(data: Path, robot_file: Path | None, measured: Measured, json_file: Path | None) -> None:
    """Zero offsets with uncertainty from a measurement file."""
    robot = read_robot(robot_file)
    readings = read_readings(robot, data, measured)
    if isinstance(robot, Arm):
        _identify_arm(identify_arm(robot, readings), data, json_file)
        return
    fit = identify(robot, readings)
    content = {"data": describe(data, len(fit.measurements) + len(fit.outliers)), **fit.as_json()}
    if json_file:
        write_json(json_file, content)
    _print(fit, content)


def _identify_arm(found: ArmIdentification, data: Path, json_file: Path | None) -> None:
    content = found.as_json()
    kept = len(found.fit.model.mechanism.measurements)
    if json_file:
        write_json(json_file, {"data": describe(data, kept + len(found.outliers)), **content})
    console = Console()
    console.print(_table(found.parameters, kept))
    residual, weak = content["residual"], content["weak_direction"]
    console.print(f"Residual rms {residual['rms_mm']:.4f} mm, largest {residual['max_mm']:.4f} mm.")
    console.print(f"Weakest: {weak['text']}. Held by tolerances alone: {'; '.join(weak['blind'])}.")
    for outlier in found.outliers:
        console.print(f"Left out: reading {outlier.reading}, {outlier.reason}.")
    if found.sd_factor > 1.0:
        console.print(
            f"The model does not fit: the uncertainties were widened by {found.sd_factor:.1f}; "
            "`station diagnose` looks for the cause."
        )


def _table(quantities: Iterable[Quantity], readings: int) -> Table:
    table = Table("parameter", "value", "sd", "unit", title=f"{readings} readings")
    for column in table.columns[1:3]:
        column.justify = "right"
    for q in quantities:
        table.add_row(q.name, f"{q.value:.4f}", f"{q.sd:.4f}", q.unit)
    return table


def describe(path: Path, readings: int) -> dict[str, Any]:
    """What a result was made from."""
    return {
        "file": path.name,
        "readings": readings,
        "sha256": hashlib.sha256(path.read_bytes()).hexdigest(),
    }


def check_folders(*files: Path | None) -> None:
    """Before minutes of work, not after.  :raises click.UsageError: there is no such folder."""
    for file in files:
        if file and not file.parent.is_dir():
            raise click.UsageError(f"{file} cannot be written: there is no folder {file.parent}.")


def write_json(path: Path, content: dict[str, Any]) -> None:
    """Finite numbers only.  :raises click.UsageError: the file cannot be written."""
    write_text(path, json.dumps(content, indent=1, allow_nan=False) + "\n")


def write_text(path: Path, text: str) -> None:
    """:raises click.UsageError: the file cannot be written."""
    try:
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise click.UsageError(f"{path} cannot be written: {error.strerror}.") from error


def _print(fit: Identification, content: dict[str, Any]) -> None:
    console = Console()
    k = fit.noise.coverage_factor
    console.print(_table((*fit.quantities(), *fit.modes()), len(fit.measurements)))
    weak, residual = content["weak_direction"], content["residual"]
    console.print(
        f"95 % interval: value +- {k:.2f} sd. Noise {fit.noise.sigma_mm * 1e3:.2f} um "
        f"({fit.noise.source}), residual rms {residual['rms_mm'] * 1e3:.2f} um."
    )
    console.print(f"Weakest: {weak['text']}, sd {weak['sd_deg']:.4f} deg.")
    for remedy in weak["remedies"]:
        console.print(f"  {remedy['text']}: sd {remedy['sd_deg']:.4f} deg")
    console.print("Blind to one distance: " + "; ".join(weak["blind"]) + ".")
    for outlier in fit.outliers:
        console.print(f"Left out: reading {outlier.reading}, {outlier.reason}.")
    if not fit.adequate:
        console.print(
            f"The model does not fit (p = {fit.lack_of_fit_p:.1g}): the uncertainties were widened by "
            f"{fit.sd_factor:.1f}; `station diagnose` looks for the cause."
        )


@click.command("plan")
@click.option("--plan", "name", type=click.Choice(get_args(PlanName)), default="paper")
@click.option("--robot", "robot_file", type=existing, help="Robot file; without it the paper's Table 1.")
@click.option("--json", "json_file", type=existing, help="Write the plan here.")
@click.option("--html", "html_file", type=existing, help="Write the plan as a page with drawings here.")
def plan_command(
    name: PlanName, robot_file: Path | None, json_file: Path | None, html_file: Path | None
) -> None:
    """The positions of a plan, their order and the accuracy they predict."""
    robot = Robot.from_toml(robot_file) if robot_file else Robot.default()
    plan = make_plan(name, robot)
    content = plan.as_json()
    if json_file:
        write_json(json_file, content)
    if html_file:
        write_text(html_file, plan_page(plan).to_html())
    table = Table("stop", "position", "x mm", "y mm", "theta1 deg", "theta2 deg", "approach")
    for k, stop in enumerate(plan.stops):
        table.add_row(
            str(k + 1),
            stop.position,
            *(f"{v:.1f}" for v in stop.target_mm),
            *(f"{v:.4f}" for v in stop.theta_deg),
            " ".join(f"{a:+d}" if a else "any" for a in stop.approach),
        )
    console = Console()
    console.print(table)
    click.echo(plan_as_text(plan, robot))
    console.print(plan.summary())
