"""`station gauge-study`: repeatability and reproducibility from a table of repeated measurements."""

from __future__ import annotations

from pathlib import Path

import click
from rich.console import Console
from rich.table import Table

from station.cli.files import check_folders, content_of, existing, write_json
from station.quality import GaugeStudy, gauge_study
from station.records import read_table

COLUMNS = ("part", "operator", "trial", "value")
NAMES = {
    "ev": "repeatability (EV)",
    "av": "reproducibility (AV)",
    "grr": "gauge (GRR)",
    "pv": "parts (PV)",
}


@click.command("gauge-study")
@click.argument("data", type=existing)
@click.option("--json", "json_file", type=existing, help="Write every figure here.")
def gauge_study_command(data: Path, json_file: Path | None) -> None:
    """Crossed gauge study of a CSV file with the columns part, operator, trial and value."""
    check_folders(json_file)
    table = read_table(content_of(data), COLUMNS, (), data.name)
    seen: dict[tuple[str, str, str], int] = {}
    part, operator, trial = (table.text(name) for name in COLUMNS[:3])
    for k, cell in enumerate(zip(part, operator, trial, strict=True)):
        for name, text in zip(COLUMNS, cell, strict=False):
            if not text:
                raise table.refuse(k, name, "is empty; fill it or remove the row.")
        if cell in seen:
            raise table.refuse(k, "trial", f"this trial was given in row {table.lines[seen[cell]]} already.")
        seen[cell] = k
    study = gauge_study(part, operator, table.numbers("value"))
    if json_file:
        write_json(json_file, study)
    _show(study)


def _show(study: GaugeStudy) -> None:
    console = Console(highlight=False)
    table = Table("source", "standard deviation", "95 % interval", "% of total", "95 % interval")
    for name, title in NAMES.items():
        of, share = study.intervals[name], study.intervals[f"{name}_percent"]
        table.add_row(
            title,
            f"{getattr(study, name):.6g}",
            f"{of.low:.4g} to {of.high:.4g}",
            f"{getattr(study, f'{name}_percent'):.1f}",
            f"{share.low:.1f} to {share.high:.1f}",
        )
    total = study.intervals["tv"]
    table.add_row("total (TV)", f"{study.tv:.6g}", f"{total.low:.4g} to {total.high:.4g}", "100", "")
    console.print(table)
    interaction = "counts as repeatability" if study.interaction_pooled else "is kept"
    console.print(
        f"{study.parts} parts, {study.operators} operators, {study.trials} trials. The interaction of "
        f"operator and part {interaction} (p = {study.interaction_p_value:.3g}). The gauge distinguishes "
        f"{study.ndc} {'category' if study.ndc == 1 else 'categories'} of parts.",
        soft_wrap=True,
    )
