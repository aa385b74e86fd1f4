"""`station confusion`: the diagnosis against random machines."""

from __future__ import annotations

import time
from pathlib import Path

import click
from rich.console import Console

from station.cli.files import check_folders, write_json, write_text
from station.studies.confusion import KINDS, figures, label, markdown, run
from station.studies.engine import Engine, digest


@click.command("confusion")
@click.option("--machines", default=300, show_default=True, type=click.IntRange(1), help="Of each kind.")
@click.option("--seed", default=1, show_default=True, type=click.IntRange(0))
@click.option(
    "--kind",
    "kinds",
    multiple=True,
    type=click.Choice([label(kind) for kind in KINDS]),
    help="Only machines of this kind; may be given again.",
)
@click.option("--workers", type=click.IntRange(1), help="Processes; one for each core without it.")
@click.option("--resume", type=click.Path(file_okay=False, path_type=Path), help="Folder to go on from.")
@click.option("--json", "json_file", type=click.Path(path_type=Path), help="Write every figure here.")
@click.option("--markdown", "out", type=click.Path(path_type=Path), help="Write the page here.")
def confusion_command(
    machines: int,
    seed: int,
    kinds: tuple[str, ...],
    workers: int | None,
    resume: Path | None,
    json_file: Path | None,
    out: Path | None,
) -> None:
    """How often the diagnosis names the right cause, on random emulated machines."""
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
