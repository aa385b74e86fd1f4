"""`station certificate` and `verify-certificate`."""

from __future__ import annotations

from contextlib import nullcontext
from pathlib import Path

import click

from station.certificate import FORMATS, issue, public_key_of, station_key, verify_certificate
from station.cli.kept import config_option, kept, run_argument
from station.errors import InputRefused, NotApplicable
from station.messages import LANGUAGES, Language
from station.records import content_of
from station.settings import database_path, load_settings


@click.command("certificate")
@run_argument
@click.argument("file", type=click.Path(dir_okay=False, path_type=Path))
@click.option(
    "--language",
    type=click.Choice(LANGUAGES),
    default="en",
    show_default=True,
    help="Language of the certificate.",
)
@config_option
@click.pass_obj
def certificate_command(
    home: Path, calibration_id: int, file: Path, language: Language, config: Path | None
) -> None:
    """Write the certificate of a run as FILE, whose name ends in .html, .pdf or .json."""
    form = file.suffix.lower().removeprefix(".")
    if form not in FORMATS:
        raise InputRefused(f"{file}: the name of a certificate must end in .{', .'.join(FORMATS)}.")
    settings = load_settings(config)
    with kept(home, config) as store:
        try:
            issued = issue(
                store,
                calibration_id,
                form,
                home=home,
                joints=settings.joints,
                language=language,
            )
        except NotApplicable as error:
            raise InputRefused(str(error)) from error
    try:
        file.write_bytes(issued.content)
    except OSError as error:
        raise InputRefused(f"{file} cannot be written: {error.strerror}.") from error
    click.echo(f"The certificate of run {calibration_id} is in {file}.", err=True)


@click.command("verify-certificate")
@click.argument("file", type=click.Path(dir_okay=False, path_type=Path))
@click.option(
    "--key",
    "key_file",
    type=click.Path(dir_okay=False, path_type=Path),
    help="Public key of the station from `station key public`, if its history is not on this computer.",
)
@config_option
@click.pass_context
def verify_certificate_command(
    context: click.Context, file: Path, key_file: Path | None, config: Path | None
) -> None:
    """Check whether a certificate was changed, with the history or with --key.

    Exit status 1: the certificate was changed; each changed field is named.
    """
    home: Path = context.obj
    there = database_path(load_settings(config), home).exists()
    key = station_key(home)
    if key_file is not None:
        key = public_key_of(content_of(key_file), str(key_file))
    with kept(home, config) if there else nullcontext() as store:
        found = verify_certificate(file, store, key)
    for fault in found.faults:
        click.echo(f"NOT VALID: {fault}")
    if not found.holds:
        context.exit(1)
    click.echo(f"Valid: certificate {found.number} of run {found.run}, checked against {found.by}.")
