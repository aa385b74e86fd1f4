"""`station confusion`: the diagnosis against random machines."""

from __future__ import annotations

import time
from pathlib import Path

import click
from rich.console import Console

from station.cli.files import check_folders, file_path, json_option, write_json, write_text
from station.studies.confusion import KINDS, figures, label, markdown, run
from station.studies.engine import Engine, digest
from station.studies.options import resume_option, seed_option, workers_option


@click.command("confusion")
@click.option(
    "--machines",
    default=300,
    show_default=True,
    type=click.IntRange(1),
    help="Number of machines of each kind.",
)
@seed_option
@click.option(
    "--kind",
    "kinds",
    multiple=True,
    type=click.Choice([label(kind) for kind in KINDS]),
    help="Kind of machine; can be given several times.  [default: all]",
)
@workers_option
@resume_option
@json_option("every figure")
@click.option("--markdown", "out", type=file_path, help="File for the page, in Markdown.")
def confusion_command(
    machines: int,
    seed: int,
    kinds: tuple[str, ...],
    workers: int | None,
    resume: Path | None,
    json_file: Path | None,
    out: Path | None,
) -> None:
    """Test how often the diagnosis names the right cause, on random emulated machines."""
    check_folders(json_file, out)
    began = time.perf_counter()
    some = [kind for kind in KINDS if not kinds or label(kind) in kinds]
    rows = run(machines, seed, Engine(Console(), workers, resume), some)
    found = figures(rows)
    if json_file:
        seconds = round(time.perf_counter() - began, 1)
        summary = {"study": "confusion", "machines": machines, "seed": seed, "seconds": seconds}
        write_json(json_file, {**summary, "digest": digest(found), "figures": found})
    text = markdown(rows, seed)
    if out:
        write_text(out, text)
    click.echo(text)
