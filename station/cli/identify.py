"""`station identify`: zero offsets from a measurement file."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import click
from rich.console import Console
from rich.table import Table

from station.cli.files import (
    columns_option,
    describe,
    file_path,
    json_option,
    measured_option,
    robot_option,
    write_json,
)
from station.cli.references import reference_line, references_option
from station.five_bar import Robot
from station.identification import Identification, identification_document, identify
from station.machines import AnyMechanism, read_readings, read_robot
from station.records import AnyReference, ColumnMap, IdentificationDocument, Measured, Quantity


@click.command("identify")
@click.argument("data", type=file_path)
@robot_option
@measured_option
@columns_option
@references_option
@json_option("the whole result")
def identify_command(
    data: Path,
    robot_file: Path | None,
    measured: Measured,
    mapping: ColumnMap | None,
    references: tuple[AnyReference, ...],
    json_file: Path | None,
) -> None:
    """Compute zero offsets with uncertainty from a measurement file."""
    robot = read_robot(robot_file)
    if references:
        if not isinstance(robot, Robot):
            raise click.UsageError(
                "--reference is only for five-bars; this robot file describes another machine."
            )
        robot = robot.informed(references)
    readings = read_readings(robot, data, measured, mapping=mapping)
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
    for use in document.references:
        console.print(f"Reference {reference_line(use)}")
    for outlier in found.outliers:
        console.print(f"Left out: reading {outlier.reading}, {outlier.reason}.")
    if document.jump:
        console.print(
            f"Warning: {document.jump.text} The zero offsets are not those of the machine as it is now; "
            "`station diagnose` examines the cause."
        )
    if not found.solution.complete:
        console.print(f"Warning: the fit {found.solution.message}; each uncertainty includes that step.")
    if found.sd_factor > 1.0:
        console.print(
            f"The model does not fit (p = {found.lack_of_fit_p:.1g}): each standard uncertainty is "
            f"multiplied by {found.sd_factor:.1f}; `station diagnose` looks for the cause."
        )
