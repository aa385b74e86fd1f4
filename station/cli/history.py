"""`station runs`, `show` and `memory`: the history on the terminal, with or without the service running."""

from __future__ import annotations

import csv
import json
import sys
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from itertools import islice
from pathlib import Path

import click
from pydantic import JsonValue
from rich.console import Console

from station.cli.kept import at_terminal, config_option, kept, run_argument
from station.cli.listing import print_list
from station.records import Calibration, Reading, State, StoredEvent, harmless
from station.store import Store

_COLUMNS = (
    "id",
    "uid",
    "created_at",
    "robot_serial",
    "kind",
    "plan",
    "of",
    "operator",
    "work_order",
    "state",
    "verdict",
    "outcome",
    "dtheta1_deg",
    "dtheta1_sd_deg",
    "dtheta2_deg",
    "dtheta2_sd_deg",
    "step",
    "steps",
    "started_at",
    "ended_at",
    "reason",
)
_DETAILS = (
    "id", "uid", "robot_serial", "kind", "plan", "operator", "work_order", "state", "verdict", "outcome",
    "reason", "created_at", "started_at", "ended_at",
)  # fmt: skip
_SHOWN = ("id", "created_at", "robot_serial", "plan", "state", "verdict", "dtheta1_deg", "dtheta2_deg")


@click.command("runs")
@click.option("--csv", "as_csv", is_flag=True, help="Write all columns as CSV to standard output.")
@click.option(
    "--limit", type=click.IntRange(1), help="Number of rows.  [default: 20 on the screen, all as CSV]"
)
@click.option("--serial", help="Only runs of this robot.")
@click.option("--state", type=click.Choice([str(state) for state in State]), help="Only runs in this state.")
@click.option("--verdict", type=click.Choice(["pass", "fail"]), help="Only runs with this verdict.")
@config_option
@click.pass_obj
def runs_command(
    home: Path,
    as_csv: bool,
    limit: int | None,
    serial: str | None,
    state: str | None,
    verdict: str | None,
    config: Path | None,
) -> None:
    """List the runs, newest first."""
    with kept(home, config) as store:
        rows = _every(store, robot_serial=serial, state=state, verdict=verdict)
        if as_csv:
            writer = csv.DictWriter(sys.stdout, _COLUMNS)
            writer.writeheader()
            writer.writerows(
                {name: harmless(cell) if isinstance(cell, str) else cell for name, cell in row.items()}
                for row in islice(rows, limit)
            )
        else:
            header = [column.split("_")[0] for column in _SHOWN]
            print_list(header, [_shown_run(row) for row in islice(rows, limit or 20)], "No runs.")


def _every(store: Store, **wanted: str | None) -> Iterator[dict[str, JsonValue]]:
    """One flat row a run, with every column of `_COLUMNS`."""
    cursor: int | None = None
    while True:
        page = store.calibrations(limit=500, cursor=cursor, **wanted)  # type: ignore[arg-type]
        for item in page.items:
            row = item.model_dump(mode="json")
            for zero in item.zero_offsets:
                row[f"dtheta{zero.joint}_deg"] = zero.value_deg
                row[f"dtheta{zero.joint}_sd_deg"] = zero.sd_deg
            yield {column: row.get(column) for column in _COLUMNS}
        cursor = page.next
        if cursor is None:
            return


def _shown_run(row: dict[str, JsonValue]) -> list[str]:
    created = str(row["created_at"])[:16].replace("T", " ")
    shown = {**row, "created_at": created}
    return [_cell(shown[column]) for column in _SHOWN]


def _cell(value: object) -> str:
    if value is None:
        return ""
    return f"{value:+.4f}" if isinstance(value, float) else str(value)


def _shown_reading(reading: Reading) -> dict[str, object]:
    """Under the names of REST and the database."""
    row = asdict(reading)
    row["walk"] = row.pop("sequence")
    return row


@click.command("show")
@run_argument
@click.option("--json", "as_json", is_flag=True, help="Print everything as JSON, with readings and events.")
@config_option
@click.pass_obj
def show_command(home: Path, calibration_id: int, as_json: bool, config: Path | None) -> None:
    """Show one run."""
    with kept(home, config) as store:
        calibration = store.calibration(calibration_id)
        readings = store.readings(calibration_id)
        events = store.events(calibration_id)
    if as_json:
        content = {
            **calibration.model_dump(mode="json", by_alias=True),
            "readings": [_shown_reading(reading) for reading in readings],
            "events": [event.model_dump(mode="json") for event in events],
        }
        click.echo(json.dumps(content, indent=1))
        return
    console = Console(highlight=False)
    for name, said in _described(calibration, len(readings), events):
        console.print(f"{name:>14}  {said}", soft_wrap=True)


def _described(
    calibration: Calibration, readings: int, events: Sequence[StoredEvent]
) -> Iterator[tuple[str, object]]:
    """Name and what is said under it, line by line."""
    row = calibration.model_dump(mode="json", include=set(_DETAILS))
    for key in _DETAILS:
        yield key.removesuffix("_at").replace("_", " "), row[key] or ""
    if memory := calibration.memory:
        age_days = memory.age_days or 0.0
        yield "memory", f"of run {memory.from_calibration}, {age_days:.1f} days old: {memory.text}"
    if fleet := calibration.fleet:
        yield "others", f"{', '.join(fleet.prior.serials)}: {fleet.text}"
    for zero in calibration.zero_offsets:
        yield f"dtheta{zero.joint}", f"{zero.value_deg or 0.0:+.4f} deg, sd {zero.sd_deg or 0.0:.4f}"
    yield "readings", readings
    for event in events:
        yield event.kind, f"{event.at} {event.data}"


@click.command("memory")
@click.argument("serial")
@click.option("--clear", is_flag=True, help="Clear the memory; the next run starts without it.")
@config_option
@click.pass_obj
def memory_command(home: Path, serial: str, clear: bool, config: Path | None) -> None:
    """Show or clear what the next run of a robot knows from earlier runs."""
    console = Console(highlight=False)
    with kept(home, config, writing=clear) as store:
        store.robot(serial)
        if clear:
            store.forget(serial, at_terminal())
        memory = store.memory(serial)
    if memory is None:
        console.print(f"Nothing is remembered of robot {serial}.")
        return
    known = memory.summary()
    console.print(f"Robot {serial}, from run {known.from_calibration}, {known.age_days:.1f} days old:")
    for q in known.parameters:
        console.print(f"{q.name:>14}  {q.value:+.4f} {q.unit}, sd {q.sd:.4f}")
