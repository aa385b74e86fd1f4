"""How commands open the history of a data folder, and what names it and a run."""

from __future__ import annotations

import getpass
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

import click

from station.cli.files import file_path
from station.errors import InputRefused
from station.records import LARGEST_ID, Actor
from station.settings import database_path, load_settings
from station.store import Store

config_option = click.option(
    "--config", type=file_path, help="Station file; it states the location of the database."
)

run_argument = click.argument("calibration_id", metavar="ID", type=click.IntRange(1, LARGEST_ID))


def at_terminal() -> Actor:
    """Who types, as the computer knows them."""
    return Actor(name=getpass.getuser(), via="terminal")


@contextmanager
def kept(home: Path, config: Path | None, *, writing: bool = False) -> Iterator[Store]:
    """The store that is there, to be read alone by default; a mistyped folder does not begin a new one.

    :raises InputRefused: there is none.
    """
    path = database_path(load_settings(config), home)
    if not path.exists():
        raise InputRefused(
            f"There is no history at {path}; check --home, STATION_HOME and --config, or measure first."
        )
    with closing(Store(path, read_only=not writing)) as store:
        yield store


@contextmanager
def open_or_begin(home: Path, config: Path | None) -> Iterator[Store]:
    """The store to be written; a new one begins where there is none, so that keys come before the start.

    :raises InputRefused: it cannot be opened.
    """
    path = database_path(load_settings(config), home)
    if new := new_history(path):
        click.echo(new, err=True)
    with closing(Store(path)) as store:
        yield store


def new_history(path: Path) -> str:
    """One line for the terminal where a command is about to begin a history, else empty."""
    return "" if path.exists() else f"A new history begins at {path}."
