"""`station calibrate`: one calibration from the terminal."""

from __future__ import annotations

from pathlib import Path

import click

from station.cli.files import file_path
from station.cli.machine_options import Machine, machine_options
from station.cli.one_run import one_run, operator_option
from station.cli.references import LENGTH, references_option
from station.five_bar import Robot
from station.plans import PLANS
from station.records import (
    LARGEST_ID,
    AnyReference,
    CalibrationRequest,
    PlanName,
    StudyDesign,
    checked_name,
    checked_serial,
)
from station.run_kinds import kind_of_plan
from station.service import Runtime, Submitted


class Study(click.ParamType[StudyDesign]):
    """3x2x2."""

    name = "OxMxC"

    def convert(
        self, value: str | StudyDesign, param: click.Parameter | None, ctx: click.Context | None
    ) -> StudyDesign:
        if isinstance(value, StudyDesign):
            return value
        try:
            operators, mountings, repeats = (int(part) for part in value.split("x"))
            return StudyDesign(operators=operators, mountings=mountings, repeats=repeats)
        except ValueError:
            self.fail(f"{value} is not three numbers from 2 to 10, as 3x2x2.", param, ctx)


@click.command("calibrate")
@click.option(
    "--plan", type=click.Choice(tuple(PLANS)), default="paper", show_default=True, help="Plan to measure."
)
@click.option("--serial", help="Serial number of the robot.  [default: that of the robot file]")
@click.option("--robot", "robot_file", type=file_path, help="Robot file; it is stored for later runs.")
@operator_option
@click.option("--work-order", help="Work order, stored with the run.")
@references_option
@click.option(
    "--until",
    "until_mm",
    type=LENGTH,
    help="Wanted accuracy (largest position error), for example 0.2mm, at which plan adaptive ends.",
)
@click.option(
    "--study",
    type=Study(),
    help="Operators x mountings x calibrations, for plan gauge_study.  [default: 3x2x2]",
)
@click.option(
    "--resume",
    type=click.IntRange(1, LARGEST_ID),
    metavar="RUN",
    help="Number of an interrupted gauge study to be continued.",
)
@machine_options
@click.pass_obj
def calibrate_command(
    home: Path,
    plan: PlanName,
    serial: str | None,
    robot_file: Path | None,
    operator: str,
    work_order: str | None,
    references: tuple[AnyReference, ...],
    until_mm: float | None,
    study: StudyDesign | None,
    resume: int | None,
    machine: Machine,
) -> None:
    """Carry out one calibration run, with live progress."""
    robot = Robot.from_toml(robot_file) if robot_file else Robot.default()
    if robot_file and serial not in (None, robot.serial):
        raise click.UsageError(
            f"--serial {serial} is not the robot of {robot_file}, which is {robot.serial}."
        )

    if study is not None and (plan != "gauge_study" or resume is not None):
        raise click.UsageError("--study can only be used with a new run of --plan gauge_study.")
    named, who = checked_serial(serial or robot.serial), checked_name(operator)
    if work_order is not None:
        checked_name(work_order)

    def submit(runtime: Runtime) -> Submitted:
        if robot_file:
            runtime.store.save_robot(robot)
        if resume is not None:
            return runtime.orchestrator.follow("gauge_study", resume, who)
        return runtime.orchestrator.submit(
            CalibrationRequest(
                named,
                kind_of_plan(plan),
                who,
                plan,
                work_order,
                references=references,
                until_mm=until_mm,
                study=study,
            )
        )

    one_run(home, machine, submit)
