"""`station identify` and `station plan`: numbers without a machine."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import get_args

import click
from rich.console import Console
from rich.table import Table

from station.five_bar import Robot
from station.identification import Identification, identification_document, identify
from station.machines import AnyMechanism, Measured, read_readings, read_robot
from station.plans import PLANS, make_plan, plan_as_text, plan_page
from station.records import DataSource, IdentificationDocument, PlanName, Quantity, Record

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
    found = identify(robot, readings)
    document = identification_document(found, describe(data, len(readings)))
    if json_file:
        write_json(json_file, document)
    _print(found, document)


def _table(quantities: Iterable[Quantity], readings: int) -> Table:
    table = Table("parameter", "value", "sd", "unit", title=f"{readings} readings")
    for column in table.columns[1:3]:
        column.justify = "right"
    for q in quantities:
        table.add_row(q.name, f"{q.value:.4f}", f"{q.sd:.4f}", q.unit)
    return table


def describe(path: Path, readings: int, guessed: Iterable[str] = ()) -> DataSource:
    """What a result was made from."""
    digest = hashlib.sha256(path.read_bytes()).hexdigest()
    return DataSource(file=path.name, readings=readings, sha256=digest, guessed=tuple(guessed))


def check_folders(*files: Path | None) -> None:
    """Before minutes of work, not after.  :raises click.UsageError: there is no such folder."""
    for file in files:
        if file and not file.parent.is_dir():
            raise click.UsageError(f"{file} cannot be written: there is no folder {file.parent}.")


def write_json(path: Path, content: Record | Mapping[str, object]) -> None:
    """Finite numbers only.  :raises click.UsageError: the file cannot be written."""
    plain = content.model_dump(by_alias=True) if isinstance(content, Record) else content
    write_text(path, json.dumps(plain, indent=1, allow_nan=False) + "\n")


def write_text(path: Path, text: str) -> None:
    """:raises click.UsageError: the file cannot be written."""
    try:
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise click.UsageError(f"{path} cannot be written: {error.strerror}.") from error


def _print(found: Identification[AnyMechanism], document: IdentificationDocument) -> None:
    console = Console(highlight=False)
    console.print(_table((*document.parameters, *document.modes), len(found.measurements)))
    weak, residual = document.weak_direction, document.residual
    console.print(
        f"95 % interval: value ± {document.coverage_factor:.2f} sd. "
        f"Noise {document.noise.sigma_mm * 1e3:.2f} µm ({document.noise.source}), "
        f"residual rms {residual.rms_mm * 1e3:.2f} µm, largest {residual.max_mm * 1e3:.2f} µm."
    )
    console.print(f"Least determined: {weak.text}, sd {weak.sd_deg or 0.0:.4f} deg.")
    for remedy in weak.remedies:
        console.print(f"  {remedy.text}: sd {remedy.sd_deg:.4f} deg")
    if weak.blind:
        console.print("Not determined by the readings: " + "; ".join(weak.blind) + ".")
    for outlier in found.outliers:
        console.print(f"Left out: reading {outlier.reading}, {outlier.reason}.")
    if found.sd_factor > 1.0:
        console.print(
            f"The model does not fit (p = {found.lack_of_fit_p:.1g}): each standard uncertainty is "
            f"multiplied by {found.sd_factor:.1f}; `station diagnose` looks for the cause."
        )


@click.command("plan")
@click.option("--plan", "name", type=click.Choice(tuple(PLANS)), default="paper")
@click.option("--robot", "robot_file", type=existing, help="Robot file; without it the paper's Table 1.")
@click.option("--json", "json_file", type=existing, help="Write the plan here.")
@click.option("--html", "html_file", type=existing, help="Write the plan as a page with drawings here.")
def plan_command(
    name: PlanName, robot_file: Path | None, json_file: Path | None, html_file: Path | None
) -> None:
    """The positions of a plan, their order and the accuracy they predict."""
    robot = Robot.from_toml(robot_file) if robot_file else Robot.default()
    plan = make_plan(name, robot)
    if json_file:
        write_json(json_file, plan.document())
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
