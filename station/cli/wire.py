"""`station wire` and `station replay`: the traffic of a run, and the run carried out again from it."""

from __future__ import annotations

from pathlib import Path

import click

from station.cli.kept import config_option, kept, run_argument
from station.motion import in_words
from station.service import replay


@click.command("wire")
@run_argument
@config_option
@click.pass_obj
def wire_command(home: Path, calibration_id: int, config: Path | None) -> None:
    """Show every request and answer of one run, with its time, in words."""
    with kept(home, config) as store:
        header, *lines = store.wire_log(calibration_id)
        size = store.wire_bytes(calibration_id)
    for line in in_words(header, lines):
        click.echo(line)
    click.echo(f"{len(lines)} entries, {size} bytes in the history.", err=True)


@click.command("replay")
@run_argument
@config_option
@click.pass_obj
def replay_command(home: Path, calibration_id: int, config: Path | None) -> None:
    """Carry out a run again from its wire log, without a machine, and compare.

    The drivers get the recorded answers; the run gets its original clock and the memory of that time.
    Exit status 1: readings or result differ.
    """
    with kept(home, config) as store:
        found = replay(store, calibration_id)
    if found.departed:
        click.echo(found.departed)
    click.echo(f"{found.readings} of {found.of} readings are the same to the bit.")
    click.echo(f"The result {'is the same to the bit' if found.same_end else 'differs'}.")
    if not found.same:
        raise SystemExit(1)
