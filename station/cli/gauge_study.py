"""`station gauge-study`: the part of the scatter that the gauge causes, from a file or from runs."""

from __future__ import annotations

from pathlib import Path

import click
from rich.console import Console
from rich.table import Table

from station.cli.files import (
    check_folders,
    file_path,
    json_option,
    write_bytes,
    write_json,
    write_text,
)
from station.cli.kept import config_option, kept
from station.errors import InputRefused
from station.quality import GaugeStudy, gauge_study
from station.records import content_of, read_table
from station.report import as_pdf
from station.run_kinds import StationGauge, gauge_page, judgement, station_gauge
from station.settings import load_settings

COLUMNS = ("part", "operator", "trial", "value")
NAMES = {
    "ev": "repeatability (EV)",
    "av": "reproducibility (AV)",
    "grr": "gauge (GRR)",
    "pv": "parts (PV)",
}


@click.command("gauge-study")
@click.argument("data", nargs=-1, required=True, metavar="DATA.csv | RUN...")
@json_option("every figure")
@click.option("--html", "html_file", type=file_path, help="File for the report on runs.")
@click.option("--pdf", "pdf_file", type=file_path, help="File for the report on runs, without charts.")
@config_option
@click.pass_obj
def gauge_study_command(
    home: Path,
    data: tuple[str, ...],
    json_file: Path | None,
    html_file: Path | None,
    pdf_file: Path | None,
    config: Path | None,
) -> None:
    """Compute how much of the scatter is caused by the gauge (crossed gauge study).

    The data are a CSV file with the columns part, operator, trial and value, or finished runs of plan
    gauge_study, one of each robot.
    """
    check_folders(json_file, html_file, pdf_file)
    if all(text.isdecimal() for text in data):
        limit_deg = load_settings(config).quality.zero_offset_deg
        with kept(home, config) as store:
            found = station_gauge(store, [int(text) for text in data], limit_deg)
        page = gauge_page(found)
        if html_file:
            write_text(html_file, page.to_html())
        if pdf_file:
            write_bytes(pdf_file, as_pdf(page))
        _show_station(found)
        if json_file:
            write_json(json_file, found)
        return
    if len(data) > 1:
        raise InputRefused("Give one file, or the numbers of runs.")
    if html_file or pdf_file:
        raise click.UsageError("--html and --pdf write the report on runs; there is none for a file.")
    study = _of_file(Path(data[0]))
    if json_file:
        write_json(json_file, study)
    _show(study)


def _of_file(data: Path) -> GaugeStudy:
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
    return gauge_study(part, operator, table.numbers("value"))


def _show_station(study: StationGauge) -> None:
    console = Console(highlight=False)
    table = Table("joint", "repeat", "mounting", "operators", "gauge", "95 % interval")
    for joint in study.joints:
        of = joint.intervals["grr"]
        table.add_row(
            str(joint.joint),
            *(f"{sd:.5f}°" for sd in (joint.repeat, joint.mounting, joint.av, joint.grr)),
            f"{of.low:.5f}° to {of.high:.5f}°",
        )
    console.print(table)
    for joint in study.joints:
        console.print(judgement(joint), soft_wrap=True)


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
