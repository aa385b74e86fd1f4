"""`station translate`: taught joint positions under new zeros."""

from __future__ import annotations

from pathlib import Path

import click

from station.cli.files import file_path, write_text
from station.cli.kept import config_option, kept
from station.errors import InputRefused, NotApplicable
from station.records import read_taught_file, translated_to_csv
from station.run_kinds import change_of, translated
from station.settings import load_settings


@click.command("translate")
@click.argument("taught", type=file_path)
@click.option(
    "--from", "run", type=click.IntRange(1), required=True, help="Number of the run that was applied."
)
@click.option(
    "--taught-under",
    type=click.IntRange(1),
    help="Run under whose zeros the positions were taught.  [default: the zeros before --from]",
)
@click.option("--back", is_flag=True, help="Convert translated positions back.")
@click.option("--csv", "csv_file", type=file_path, help="File for the positions.  [default: standard output]")
@click.option(
    "--program", "program_file", type=file_path, help="File for the program of TAUGHT with the new angles."
)
@config_option
@click.pass_obj
def translate_command(
    home: Path,
    taught: Path,
    run: int,
    taught_under: int | None,
    back: bool,
    csv_file: Path | None,
    program_file: Path | None,
    config: Path | None,
) -> None:
    """Convert taught joint positions to the present zeros: the same physical positions, new joint angles.

    TAUGHT is a CSV file, or a program in KRL or RAPID with joint targets.
    """
    try:
        positions, program = read_taught_file(taught.read_text(encoding="utf-8"), taught.name)
    except (OSError, UnicodeDecodeError) as error:
        raise InputRefused(f"{taught} cannot be read: {error}.") from error
    if program_file and program is None:
        raise InputRefused(f"{taught} is no program with joint targets in KRL or RAPID; leave out --program.")
    with kept(home, config) as store:
        try:
            change = change_of(store, run, taught_under)
        except NotApplicable as refusal:
            raise InputRefused(str(refusal)) from refusal
    change = change.back() if back else change
    new = translated(change, positions, load_settings(config).joints)
    if program and program_file:
        write_text(program_file, program.rewritten(new))
    text = translated_to_csv(new)
    if csv_file:
        write_text(csv_file, text)
    else:
        click.echo(text, nl=False)
