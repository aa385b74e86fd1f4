"""`station diagnose`, `solve` and `transfer`: the diagnosis of a file, and the use of its model."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path

import click
from rich.console import Console
from rich.table import Table

from station.cli.files import (
    check_folders,
    columns_option,
    describe,
    file_path,
    json_option,
    measured_option,
    robot_option,
    write_json,
    write_text,
)
from station.diagnosis import (
    Context,
    Findings,
    MistakeRefused,
    commands_csv,
    diagnose,
    findings_of,
    page,
    range_said,
    read_model,
    read_part,
    read_targets,
    shown,
    solve_targets,
    stage_name,
    transfer,
    without_a_quarter,
)
from station.five_bar import Robot
from station.machines import AnyRobot, read_readings, read_robot, robot_of
from station.messages import LANGUAGES, Language, effect_name, labels_in_words
from station.records import (
    ColumnMap,
    Measured,
    RefusedDiagnosis,
    guesses_in_words,
    recorded_columns,
)


@click.command("diagnose")
@click.argument("data", type=file_path)
@click.option(
    "--confirm",
    "fresh_file",
    type=file_path,
    help="Measurement file with fresh readings that test the causes.",
)
@robot_option
@click.option(
    "--hold-out",
    is_flag=True,
    help="Hold a quarter of the readings out of the fit and test the causes with them.",
)
@measured_option
@columns_option
@json_option("the whole diagnosis")
@click.option("--html", "html_file", type=file_path, help="File for the report page.")
@click.option(
    "--language",
    type=click.Choice(LANGUAGES),
    default="en",
    show_default=True,
    help="Language of the report page.",
)
@click.pass_context
def diagnose_command(
    context: click.Context,
    data: Path,
    fresh_file: Path | None,
    robot_file: Path | None,
    hold_out: bool,
    measured: Measured,
    mapping: ColumnMap | None,
    json_file: Path | None,
    html_file: Path | None,
    language: Language,
) -> None:
    """Find the causes of the residual of a measurement file.

    Exit status 0: the model fits, as it is or with the effects found; 1: it does not.
    """
    if hold_out and fresh_file:
        raise click.UsageError(
            "--hold-out and --confirm exclude each other: judge by the one or by the other."
        )
    check_folders(json_file, html_file)
    robot = read_robot(robot_file)
    measurements = read_readings(robot, data, measured, in_order=False, mapping=mapping)
    described = describe(data, len(measurements), measurements.guessed)
    fresh = (
        read_readings(robot, fresh_file, measured, in_order=False, mapping=mapping) if fresh_file else None
    )
    recorded = None if mapping else _context(robot, data)
    if hold_out:
        measurements, fresh = without_a_quarter(measurements)
    try:
        findings = findings_of(diagnose(robot, measurements, fresh, recorded))
    except MistakeRefused as refusal:
        if json_file:
            write_json(json_file, _refused(refusal))
        raise
    if json_file:
        write_json(json_file, findings.document(described))
    if html_file:
        write_text(html_file, page(findings, data.name, language).to_html())
    _print(findings)
    context.exit(0 if findings.decision.passed else 1)


@click.command("solve")
@click.argument("targets", type=file_path)
@click.option(
    "--model", "model_file", type=file_path, required=True, help="Model file, written by `diagnose --json`."
)
@click.option("--csv", "csv_file", type=file_path, help="File for the commands.  [default: standard output]")
def solve_command(targets: Path, model_file: Path, csv_file: Path | None) -> None:
    """Compute joint commands for target positions x_mm, y_mm with an identified model."""
    check_folders(csv_file)
    model = read_model(model_file)
    table, wanted = read_targets(targets)
    text = commands_csv(table, solve_targets(model, wanted))
    if csv_file:
        write_text(csv_file, text)
    else:
        click.echo(text, nl=False)
    click.echo(range_said(model).text(), err=True)
    if model.confirmed is False:
        click.echo("Fresh readings contradict this model: expect larger errors than it states.", err=True)


@click.command("transfer")
@click.argument("data", type=file_path)
@click.option(
    "--model", "model_file", type=file_path, required=True, help="Model file, written by `diagnose --json`."
)
@measured_option
@columns_option
@json_option("the figures")
def transfer_command(
    data: Path, model_file: Path, measured: Measured, mapping: ColumnMap | None, json_file: Path | None
) -> None:
    """Apply the effects learned on one log, unchanged, to another log of the same machine."""
    check_folders(json_file)
    part = read_part(model_file)
    robot = robot_of(part.robot, source=f"{model_file}: [model.robot]")
    found = transfer(part, robot, read_readings(robot, data, measured, mapping=mapping), str(model_file))
    if json_file:
        write_json(json_file, {"data": describe(data, found.readings).model_dump(), **asdict(found)})
    console = Console(highlight=False)
    console.print(
        f"{found.inside} of {found.readings} readings are in the joint ranges of the learned effects."
    )
    if found.determined < found.inside:
        console.print(
            f"{found.inside - found.determined} of them are not evaluated: without their own block, "
            "tool and base are not known well enough to predict them."
        )
    for outlier in found.outliers:
        console.print(f"Left out: reading {outlier.reading}, {outlier.reason}.")
    table = Table("readings left out of the fit, mm", "rms", "median", "largest")
    rows = [("without effects", found.alone), ("with effects, unchanged", found.applied)]
    if found.beyond:
        rows += [
            ("without effects, also in gaps of the ranges", found.beyond[0]),
            ("with effects, also in gaps of the ranges", found.beyond[1]),
        ]
    for name, e in rows:
        table.add_row(name, f"{e.rms_mm:.4f}", f"{e.median_mm:.4f}", f"{e.max_mm:.4f}")
    console.print(table)


def _context(robot: AnyRobot, data: Path) -> Context | None:
    """What a five-bar's file recorded; an arm's log says so itself."""
    if not isinstance(robot, Robot):
        return None
    recorded = recorded_columns(data.read_bytes())
    return Context("approach1" in recorded or "approach2" in recorded, "position" in recorded, data.name)


def _refused(refusal: MistakeRefused) -> RefusedDiagnosis:
    return RefusedDiagnosis(refused=str(refusal), mistake=refusal.mistake.record())


def _print(findings: Findings) -> None:
    console = Console(highlight=False)
    console.print(f"[bold]{findings.sentence}[/bold]")
    joints = findings.measurements.joints
    for q in findings.parameters[:joints]:
        console.print(f"{q.name} = {shown(q)}")
    _print_causes(console, findings)
    console.print(_errors(findings))
    if findings.measurements.guessed:
        console.print(guesses_in_words(findings.measurements))
    _print_position_errors(console, findings)
    for hint in findings.hints:
        console.print(f"Hint: {hint.said.text()} ({100 * hint.strength:.0f} %)")
    for outlier in findings.outliers:
        console.print(f"Left out: reading {outlier.reading}, {outlier.reason}.")


def _print_causes(console: Console, findings: Findings) -> None:
    for found in findings.effects:
        sizes = ", ".join(f"{q.name} {shown(q)}" for q in found.parameters)
        name = effect_name(found.label, "en")
        console.print(f"[bold]{name}[/bold]: {sizes}; {100 * found.share:.0f} % of the residual")
        if found.probability is not None:
            console.print(f"  Probability {100 * found.probability:.0f} %.")
        if found.aliases:
            others = ", ".join(labels_in_words(label, "en") for label in found.alias_labels)
            experiment = found.experiment.text()
            console.print(f"  Cannot be distinguished from {others}. To distinguish: {experiment}")
        if found.remedy is not None:
            console.print(f"  {found.remedy.text()}")
    if findings.decision.verdict not in ("adequate", "explained"):
        for one in findings.explanations:
            labels = " and ".join(effect.label for effect in one.effects) or "no effect"
            named = labels_in_words(labels, "en")
            console.print(f"Explanation, {100 * one.probability:.0f} %: {named}")
    for rated in findings.experiments:
        console.print(f"{100 * rated.decides:.0f} % probable to decide: {rated.text}")
    if findings.mistake is not None:
        console.print(f"Mistake: {findings.mistake.text}")


def _errors(findings: Findings) -> Table:
    """Of every model on the way."""
    table = Table("model", "unknowns", "fit", "left out", "worst", "fresh", "worst", title="errors, µm rms")
    for column in table.columns[1:]:
        column.justify = "right"
    for s in findings.stages:
        sizes_mm = (s.fit_rms_mm, s.holdout_rms_mm, s.holdout_max_mm, s.confirm_rms_mm, s.confirm_max_mm)
        sizes_um = ("" if v is None else f"{v * 1e3:.2f}" for v in sizes_mm)
        table.add_row(stage_name(s.model, "en"), str(s.unknowns), *sizes_um)
    return table


def _print_position_errors(console: Console, findings: Findings) -> None:
    predicted = f"over the {findings.extent}, predicted"
    for what, errors in (
        (predicted, findings.position_errors),
        ("against the tracker", findings.true_position_errors),
    ):
        if errors is not None:
            before, after = errors
            console.print(
                f"Position error {what}: {before.rms:.4f} mm rms before, {after.rms:.4f} mm after; "
                f"largest {before.max:.4f} and {after.max:.4f} mm."
            )
            if after.bound_95 is not None:
                console.print(f"With 95 % probability, no error exceeds {after.bound_95:.4f} mm.")
