"""`station plan`: the positions of a plan, without a machine."""

from __future__ import annotations

from pathlib import Path

import click
from rich.console import Console
from rich.table import Table

from station.cli.files import file_path, json_option, robot_option, write_json, write_text
from station.five_bar import Robot
from station.plans import PLANS, STOP_COLUMNS, make_plan, plan_as_text, plan_page, stop_rows
from station.records import PlanName


@click.command("plan")
@click.option(
    "--plan",
    "name",
    type=click.Choice(tuple(PLANS)),
    default="paper",
    show_default=True,
    help="Plan to show.",
)
@robot_option
@json_option("the plan")
@click.option("--html", "html_file", type=file_path, help="File for a page with drawings.")
def plan_command(
    name: PlanName, robot_file: Path | None, json_file: Path | None, html_file: Path | None
) -> None:
    """Show the positions of a plan, their order and the predicted accuracy."""
    robot = Robot.from_toml(robot_file) if robot_file else Robot.default()
    plan = make_plan(name, robot)
    if json_file:
        write_json(json_file, plan.document())
    if html_file:
        write_text(html_file, plan_page(plan).to_html())
    table = Table(*STOP_COLUMNS)
    for row in stop_rows(plan):
        table.add_row(*row)
    console = Console()
    console.print(table)
    click.echo(plan_as_text(plan, robot))
    console.print(plan.summary())
