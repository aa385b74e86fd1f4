"""`station study`: Monte Carlo over machines."""

from __future__ import annotations

import json
import time
from pathlib import Path

import click
from rich.console import Console

from station.cli.files import check_folders, json_option, write_json
from station.studies.arms import arms
from station.studies.arms import figures as arms_figures
from station.studies.confusion import figures as confusion_figures
from station.studies.confusion import run as confusion
from station.studies.engine import Engine, digest
from station.studies.experiments import experiments
from station.studies.experiments import figures as experiment_figures
from station.studies.options import resume_option, seed_option, workers_option
from station.studies.population import FIGURES, population

_KINDS = (*FIGURES, "confusion", "arms", "experiments")
_PLANS = ("full", "rapid")
"""Plans with one measurement and one fit."""


@click.command("study")
@click.argument("study", type=click.Choice(_KINDS))
@click.option(
    "--machines",
    type=click.IntRange(1),
    required=True,
    help="Number of machines; of each kind for confusion, of logs for arms.",
)
@seed_option
@click.option(
    "--plan",
    type=click.Choice(_PLANS),
    default="full",
    show_default=True,
    help="Plan to measure; not for confusion, arms and experiments.",
)
@click.option(
    "--tolerance",
    type=click.FloatRange(0, 3, min_open=True),
    default=0.03,
    show_default=True,
    help="Standard deviation of lengths and base joints, mm; not for confusion, arms and experiments.",
)
@workers_option
@click.option("--scheduler", metavar="tcp://HOST:PORT", help="Dask cluster that does the computing.")
@resume_option
@json_option("every figure")
def study_command(
    study: str,
    machines: int,
    seed: int,
    plan: str,
    tolerance: float,
    workers: int | None,
    scheduler: str | None,
    resume: Path | None,
    json_file: Path | None,
) -> None:
    """Calibrate or diagnose many random machines and summarise the results.

    STUDY is accuracy, coverage or capability (one calibration for each machine), confusion (one diagnosis
    for each machine), arms (one diagnosis for each log of a serial arm), or experiments (those that a
    diagnosis suggests, carried out on each machine).  The digest is the same on one core, on several cores
    and on a cluster.
    """
    check_folders(json_file)
    engine = Engine(Console(stderr=True), workers, resume, scheduler)
    began = time.perf_counter()
    found: object
    if study == "confusion":
        found = confusion_figures(confusion(machines, seed, engine))
    elif study == "arms":
        found = arms_figures(arms(machines, seed, engine))
    elif study == "experiments":
        found = experiment_figures(experiments(machines, seed, engine))
    else:
        found = FIGURES[study](population(machines, seed, engine, plan, tolerance))
    seconds = round(time.perf_counter() - began, 1)
    summary = {
        "study": study,
        "machines": machines,
        "seed": seed,
        "digest": digest(found),
        "seconds": seconds,
    }
    if json_file:
        write_json(json_file, {**summary, "figures": found})
    click.echo(json.dumps(found, indent=1))
    click.echo(f"{machines} machines in {seconds} s; digest {summary['digest']}", err=True)
