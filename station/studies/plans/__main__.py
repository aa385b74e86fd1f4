"""`python -m station.studies.plans`: the page of the accuracy that the plans state and reach."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import click
from rich.console import Console

from station.studies.engine import Engine
from station.studies.options import page_option, resume_option, seed_option, workers_option
from station.studies.plans.advised import followed
from station.studies.plans.checks import checked
from station.studies.plans.collision import misled, struck
from station.studies.plans.fleet import taught
from station.studies.plans.page import (
    ABOUT,
    advice_table,
    cases_table,
    checks_table,
    collision_text,
    counted,
    fleet_table,
    misled_text,
    retaught_text,
    time_table,
)
from station.studies.plans.references import calibrated
from station.studies.plans.retaught import retaught

TOLERANCES_MM = (0.03, 0.003)
FLEET_MM = 0.1
"""Better geometry than this has too little effect on the readings to be learned from other robots."""


@click.command()
@click.option(
    "--machines",
    default=200,
    show_default=True,
    type=click.IntRange(2),
    help="Number of machines for each row.",
)
@click.option(
    "--many", default=2000, show_default=True, type=click.IntRange(2), help="Number of machines for shares."
)
@click.option(
    "--promises",
    default=1000,
    show_default=True,
    type=click.IntRange(2),
    help="Number of machines for plan `adaptive`.",
)
@click.option(
    "--fleets", default=50, show_default=True, type=click.IntRange(1), help="Number of fleets of 20 robots."
)
@click.option(
    "--tolerance",
    "tolerances",
    multiple=True,
    default=TOLERANCES_MM,
    help="Tolerance in mm; can be given several times.",
)
@seed_option
@workers_option
@resume_option
@page_option
def main(
    machines: int,
    many: int,
    promises: int,
    fleets: int,
    tolerances: tuple[float, ...],
    seed: int,
    workers: int | None,
    resume: Path | None,
    out: Path | None,
) -> None:
    """Compare the stated and the true accuracy of the plans on emulated machines."""
    engine = Engine(Console(stderr=True), workers, resume)
    parts = [ABOUT, time_table()]

    def part(show: Callable[[Any], str], work: Callable[[Any], Any], tolerance: float, count: int) -> None:
        items = [(tolerance, seed * 100_000 + k) for k in range(count)]
        found = engine.each(work, items, work.__name__)
        parts.append(counted(show(found), found))

    for tolerance in tolerances:
        parts.append(f"## Tolerance {tolerance} mm")
        part(cases_table, calibrated, tolerance, many)
        part(collision_text, struck, tolerance, promises)
        part(misled_text, misled, tolerance, machines)
        part(checks_table, checked, tolerance, many)
        part(advice_table, followed, tolerance, machines)
        part(retaught_text, retaught, tolerance, machines)
    parts.append(f"## Robots of one type, tolerance {FLEET_MM} mm")
    part(fleet_table, taught, FLEET_MM, fleets)
    text = "\n\n".join(parts) + "\n"
    if out:
        out.write_text(text, encoding="utf-8")
    click.echo(text)


if __name__ == "__main__":
    main()
