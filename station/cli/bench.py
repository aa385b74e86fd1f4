"""`station bench`: speed and size of the station, compared with other programs."""

from __future__ import annotations

from pathlib import Path

import click
from rich.console import Console
from rich.table import Table

from station.cli.files import check_folders, json_option, write_json
from station.studies.bench import bench


@click.command("bench")
@json_option("every figure")
@click.option("--quick", is_flag=True, help="Short histories and few repeats, for a test of the command.")
def bench_command(json_file: Path | None, quick: bool) -> None:
    """Measure speed and size, and compare them with other programs."""
    check_folders(json_file)
    console = Console()
    content = bench(console, quick=quick)
    if json_file:
        write_json(json_file, content)
    table = Table("figure", "median", "smallest", "n", "target")
    for name, target in content["targets"].items():
        table.add_row(name, *_figures(content[name]), "" if target is None else f"< {target:g}")
    for peer, figures in content["peers"].items():
        for name, figure in figures.items():
            table.add_row(f"{name}, {peer}", *_figures(figure))
    console.print(table)
    for name, relative in content["agreement"].items():
        console.print(f"{name}: agrees with a general solver to {relative:.1e}")
    console.print(f"Load of this machine: {content['machine']['load_1min']:.2f}")


def _figures(figure: dict[str, float] | None) -> tuple[str, str, str]:
    """Median, smallest and number, or that it is not measured."""
    if figure is None:
        return "not measured", "", ""
    return f"{figure['median']:.4g}", f"{figure['min']:.4g}", str(figure["n"])
