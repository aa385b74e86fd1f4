"""`station simulate`: years of a station in virtual time, with faults."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

import click
from rich.console import Console

from station.cli.files import check_folders, json_option, write_json
from station.simulation import (
    INVARIANTS,
    Case,
    Life,
    Outcome,
    Shrunk,
    carried_out,
    happenings,
    month,
    months,
    shrunk,
    writes_that_fail,
)
from station.simulation import orders as every_order
from station.studies.engine import Engine
from station.studies.options import resume_option, workers_option


@click.command("simulate")
@click.option(
    "--years",
    type=click.FloatRange(0, 1000, min_open=True),
    default=1.0,
    show_default=True,
    help="Number of station-years; 1/12 is one month of one station.",
)
@click.option(
    "--seed", type=click.IntRange(0), default=1, show_default=True, help="Seed of the random numbers."
)
@click.option(
    "--orders",
    type=click.IntRange(1, 6),
    help="Simulate every order of N of eight events instead of years: 8^N cases.",
)
@click.option(
    "--writes",
    is_flag=True,
    help="Simulate a failure and a kill at every write of two runs instead of years.",
)
@click.option(
    "--shrink",
    type=click.IntRange(0),
    help="Number of a month with a violation, to be reduced to the jobs that reproduce it.",
)
@workers_option
@resume_option
@json_option("the printed result")
def simulate_command(
    years: float,
    seed: int,
    orders: int | None,
    writes: bool,
    shrink: int | None,
    workers: int | None,
    resume: Path | None,
    json_file: Path | None,
) -> None:
    """Simulate years of a station in virtual time, with faults, and check that no rule is violated.

    The code is that of `station serve`; its clock, wires, disk and users are simulated.  Exit status 1: a
    rule was violated; the same seed reproduces it.
    """
    check_folders(json_file)
    engine = Engine(Console(stderr=True), workers, resume)
    if shrink is not None:
        found = made_short(shrunk(shrink))
    elif orders is not None or writes:
        cases: list[Case] = []
        cases += every_order(orders) if orders is not None else writes_that_fail()
        found = exhausted(engine.each(carried_out, cases, "Cases"))
    else:
        found = summary(years, seed, engine.each(month, months(years, seed), "Months", long=True))
    if json_file:
        write_json(json_file, found)
    click.echo(json.dumps(found, indent=1))
    if found["violations"]:
        raise SystemExit(1)


def made_short(found: Shrunk) -> dict[str, object]:
    """The jobs that reproduce a violation."""
    return {
        "month": found.seed,
        "lives": found.lives,
        "jobs": [asdict(job) for job in found.jobs],
        "violations": [{"sentence": INVARIANTS[found.violation.invariant], **asdict(found.violation)}],
    }


def exhausted(outcomes: Sequence[Outcome]) -> dict[str, object]:
    """The number of cases, and the violations."""
    return {
        "cases": sum(outcome.reached for outcome in outcomes),
        "violations": [
            {"case": asdict(outcome.case), "sentence": INVARIANTS[found.invariant], **asdict(found)}
            for outcome in outcomes
            for found in outcome.violations
        ],
    }


def summary(years: float, seed: int, lives: list[Life]) -> dict[str, object]:
    """Totals, violations, and the number of each deed and trouble."""
    digest = hashlib.sha256("".join(life.digest for life in lives).encode())
    return {
        "years": years,
        "seed": seed,
        "days": sum(life.days for life in lives),
        "runs": sum(life.runs for life in lives),
        "faults": dict(sorted(happenings(lives).items())),
        "restarts": sum(life.restarts for life in lives),
        "readings": sum(life.readings for life in lives),
        "digest": digest.hexdigest(),
        "violations": [
            {
                "month": life.seed,
                "day": life.days + 1,
                "sentence": INVARIANTS[found.invariant],
                **asdict(found),
            }
            for life in lives
            for found in life.violations
        ],
    }
