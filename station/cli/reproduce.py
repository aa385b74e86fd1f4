"""`station reproduce`: the paper's tables and figures, computed again."""

from __future__ import annotations

from pathlib import Path

import click
from rich.console import Console
from rich.table import Table

from station.cli.files import check_folders, json_option, new_file, write_json, write_text
from station.studies.engine import Engine
from station.studies.options import resume_option, workers_option
from station.studies.reproduce import make_page, run_study

SEEDS = 200


@click.command("reproduce")
@json_option("every figure")
@click.option("--html", "html_file", type=new_file, help="File for a page with tables and plots.")
@workers_option
@resume_option
@click.option(
    "--seeds",
    type=click.IntRange(2),
    default=SEEDS,
    show_default=True,
    help="Number of machines for each row.",
)
def reproduce_command(
    json_file: Path | None,
    html_file: Path | None,
    seeds: int,
    workers: int | None,
    resume: Path | None,
) -> None:
    """Compute the tables and figures of the paper again."""
    check_folders(json_file, html_file)
    console = Console()
    content = run_study(seeds, Engine(console, workers, resume))
    if json_file:
        write_json(json_file, content)
    if html_file:
        write_text(html_file, make_page(content).to_html())
    console.print(
        f"kappa_1 = {content['kappa_1']:.2f}, kappa_m = {content['kappa_m']:.2f} (f = {content['f']})"
    )
    table = Table("group", "method", "largest error mm", "bound mm", "ratio", "target mm", title="One sample")
    for row in content["accuracy"]:
        if row["servo"] == "whole pulses" and row["samples"] == 1:
            table.add_row(
                str(row["group"]),
                row["variant"],
                f"{row['workspace_mm']['median']:.3f}",
                *(f"{row[key]:.3f}" if row[key] else "" for key in ("bound_mm", "ratio", "target_mm")),
            )
    console.print(table)
    for erratum in content["errata"]:
        console.print(f"{erratum['where']}: {erratum['printed']} -> {erratum['found']}", markup=False)
