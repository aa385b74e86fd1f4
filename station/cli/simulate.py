"""`station simulate`: years of a station in virtual time, with everything that can go wrong."""

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
    help="Station-years; a twelfth is a month of one station.",
)
@click.option("--seed", type=click.IntRange(0), default=1, show_default=True, help="Of the years.")
@click.option(
    "--orders",
    type=click.IntRange(1, 6),
    help="Instead: every order of so many of eight events, 8^N stations.",
)
@click.option("--writes", is_flag=True, help="Instead: a failure and a kill at every write of two runs.")
@click.option("--shrink", type=click.IntRange(0), help="Instead: a month that broke a sentence, made short.")
@workers_option
@resume_option
@json_option("what is printed")
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
    """Let stations live for years, in virtual time, and look whether what must hold holds.

    The station is the one that `station serve` runs; simulated are its clock, its wires, its disk and the
    people.  Exit status 1: something did not hold, and the same seed shows it again.
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
    """The jobs that a violation takes."""
    return {
        "month": found.seed,
        "lives": found.lives,
        "jobs": [asdict(job) for job in found.jobs],
        "violations": [{"sentence": INVARIANTS[found.violation.invariant], **asdict(found.violation)}],
    }


def exhausted(outcomes: Sequence[Outcome]) -> dict[str, object]:
    """How many cases there were, and those in which something did not hold."""
    return {
        "cases": sum(outcome.reached for outcome in outcomes),
        "violations": [
            {"case": asdict(outcome.case), "sentence": INVARIANTS[found.invariant], **asdict(found)}
            for outcome in outcomes
            for found in outcome.violations
        ],
    }


def summary(years: float, seed: int, lives: list[Life]) -> dict[str, object]:
    """As the contract has it, and how often each deed and trouble came."""
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
