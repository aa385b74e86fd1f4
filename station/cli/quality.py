"""`station quality`: is the process capable?"""

from __future__ import annotations

from datetime import datetime
from pathlib import Path

import click
from rich.console import Console
from rich.table import Table

from station.cli.files import check_folders, json_option, write_json
from station.cli.kept import config_option, kept
from station.quality import RULE_TEXTS, Figure, Quality, quality
from station.settings import load_settings

NAMES = {
    "dtheta1": "zero offset of joint 1",
    "dtheta2": "zero offset of joint 2",
    "position_error": "position error",
}


@click.command("quality")
@click.option("--robot", "serial", help="Only runs of this robot.")
@click.option("--type", "robot_type", help="Only runs of robots of this type (`type` in the robot file).")
@click.option(
    "--since",
    type=click.DateTime(["%Y-%m-%d", "%Y-%m-%dT%H:%M:%S"]),
    help="Only runs that ended at this time or later, UTC.",
)
@json_option("every figure")
@config_option
@click.pass_obj
def quality_command(
    home: Path,
    serial: str | None,
    robot_type: str | None,
    since: datetime | None,
    json_file: Path | None,
    config: Path | None,
) -> None:
    """Show capability, run rules and a Pareto chart of outcomes of the newest finished calibrations."""
    check_folders(json_file)
    limits = load_settings(config).quality
    with kept(home, config) as store:
        points = store.trend(limit=limits.runs, robot_serial=serial, robot_type=robot_type, since=since)
    found = quality(
        points, zero_offset_deg=limits.zero_offset_deg, position_error_mm=limits.position_error_mm
    )
    if json_file:
        write_json(json_file, found)
    _show(found)


def _show(found: Quality) -> None:
    console = Console(highlight=False)
    table = Table("quantity", "runs", "mean", "sd", "limits", "Cpk (95 %)", "Ppk (95 %)")
    figures = {name: getattr(found, name) for name in NAMES}
    for name, title in NAMES.items():
        figure: Figure = figures[name]
        table.add_row(
            f"{title}, {figure.unit}",
            str(figure.n),
            *("" if v is None else f"{v:.4f}" for v in (figure.mean, figure.sd)),
            " to ".join("" if v is None else f"{v:g}" for v in (figure.low_limit, figure.high_limit)),
            _index(figure.cpk, figure.cpk_low, figure.cpk_high),
            _index(figure.ppk, figure.ppk_low, figure.ppk_high),
        )
    console.print(table)
    for name, title in NAMES.items():
        for rule in dict.fromkeys(broken.name for broken in figures[name].rules):
            at = ", ".join(str(broken.at) for broken in figures[name].rules if broken.name == rule)
            console.print(f"{title}: {RULE_TEXTS[rule]} (runs {at}).", soft_wrap=True)
    ended = Table("outcome", "reason", "runs")
    for row in found.pareto:
        ended.add_row(row.outcome or "", row.reason_code or "", str(row.count))
    console.print(ended)


def _index(value: float | None, low: float | None, high: float | None) -> str:
    return "" if value is None else f"{value:.2f} ({low:.2f} to {high:.2f})"
