"""`python -m station.studies.plans`: the page of what the plans promise and reach."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import click
import numpy as np
from rich.console import Console

from station.studies.engine import Engine
from station.studies.plans.rows import CASES, Checked, Kept, Struck, calibrated, checked, struck

TOLERANCES_MM = (0.03, 0.003)
ABOUT = """# What the plans reach
Machines drawn from the tolerances of the robot file (zero offsets uniform within 3 degrees, geometry and
mounting normal), five samples a reading, servos with the scatter of eq. 35 on whole pulses, scale with the
noise of eq. 34.  Positions are those of the emulated machine's own geometry, over a grid of 13 x 9.

- *largest*: the largest position error over the workspace with the zeros in the drives only, a median with
  its standard error.
- *kept*: the share of machines below their 95 % bound, with the zeros only and with commands of the model.

`python -m station.studies.plans` makes this page again."""


@click.command()
@click.option("--machines", default=200, show_default=True, type=click.IntRange(2), help="A row.")
@click.option("--seed", default=1, show_default=True, type=click.IntRange(0))
@click.option("--workers", type=click.IntRange(1), help="Processes; one for each core without it.")
@click.option("--resume", type=click.Path(file_okay=False, path_type=Path), help="Folder to go on from.")
@click.option("--out", type=click.Path(path_type=Path), help="Write the page here.")
def main(machines: int, seed: int, workers: int | None, resume: Path | None, out: Path | None) -> None:
    """What the plans promise, and what comes of it, on emulated machines."""
    engine = Engine(Console(stderr=True), workers, resume)
    parts = [ABOUT, f"{machines} machines a row, seed {seed}."]
    for tolerance in TOLERANCES_MM:
        items = [(tolerance, seed * 100_000 + k) for k in range(machines)]
        parts += [
            f"## Tolerance {tolerance} mm",
            _cases(engine.each(calibrated, items, f"calibrated, {tolerance} mm")),
            _collision(engine.each(struck, items, f"struck, {tolerance} mm")),
            _checks(engine.each(checked, items, f"checked, {tolerance} mm")),
        ]
    text = "\n\n".join(parts) + "\n"
    if out:
        out.write_text(text, encoding="utf-8")
    click.echo(text)


def _cases(found: Sequence[dict[str, Kept]]) -> str:
    lines = [
        "| case | largest, mm | bound, mm | kept, zeros only | kept, model |",
        "|---|---|---|---|---|",
    ]
    for case in CASES:
        kept = [one[case] for one in found]
        lines.append(f"| {case} | {_row(kept)} |")
    return "\n".join(lines)


def _row(kept: Sequence[Kept]) -> str:
    held = [one.largest_mm <= one.bound_mm for one in kept]
    by_model = [one.by_model_mm <= one.bound_by_model_mm for one in kept]
    bound = np.median([one.bound_mm for one in kept])
    return f"{_median([one.largest_mm for one in kept])} | {bound:.3f} | {_share(held)} | {_share(by_model)}"


def _collision(found: Sequence[Struck]) -> str:
    readings, seconds = [one.readings for one in found], [one.machine_s for one in found]
    through = [one.change for one in found if one.let_through]
    return (
        "Plan `adaptive` after a collision, to 1.01 of the bound of the full run before:"
        f" {np.median(readings):.0f} readings"
        f" (90 %: {np.quantile(readings, 0.9):.0f}), {np.median(seconds):.1f} s;"
        f" memory used in {_share([one.memory_used for one in found])}, wish reached in"
        f" {_share([one.reached for one in found])}.\n\n"
        "| case | largest, mm | bound, mm | kept, zeros only | kept, model |\n|---|---|---|---|---|\n"
        f"| adaptive | {_row([one.kept for one in found])} |\n\n"
        f"Wrong memory (mounted anew by 1 mm, a link changed by 0.3 mm) let through:"
        f" {_share([one.let_through for one in found])}{': ' + ', '.join(through) if through else ''}."
    )


def _checks(found: Sequence[Checked]) -> str:
    return (
        f"Plan `check`: smallest shift {np.median([one.smallest_deg for one in found]):.4f} deg, found in"
        f" {_share([one.found for one in found])}; false alarms {_share([one.false_alarm for one in found])}."
    )


def _median(values: Sequence[float]) -> str:
    """With its standard error, from the order statistics of a normal approximation."""
    ordered, n = np.sort(values), len(values)
    half = np.sqrt(n) / 2.0
    low, high = ordered[max(0, int(n / 2 - half))], ordered[min(n - 1, int(n / 2 + half))]
    return f"{np.median(values):.3f} ± {(high - low) / 2.0:.3f}"


def _share(hits: Sequence[bool]) -> str:
    return f"{100.0 * np.mean(hits):.1f} %"


if __name__ == "__main__":
    main()
