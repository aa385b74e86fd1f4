"""What the commands share that need the machine: which one it is, and where the log goes."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import wraps
from logging.handlers import RotatingFileHandler
from pathlib import Path
from typing import Any

import click

from station.cli.files import file_path
from station.errors import InputRefused
from station.records import one_line
from station.settings import Settings, load_settings

_FORMAT = "%(asctime)s %(levelname)s %(name)s: %(message)s"
_LOG_BYTES, _LOG_FILES = 2_000_000, 5


class _OneLine(logging.Formatter):
    """A message stays on its line: names and answers from outside must not look like further entries."""

    def formatMessage(self, record: logging.LogRecord) -> str:  # noqa: N802 - the library's name
        record.message = one_line(record.message)
        return super().formatMessage(record)


@dataclass(frozen=True, slots=True)
class Machine:
    """Which one a command works with."""

    settings: Settings
    emulate: Path | None
    """Rig file of the emulated machine."""


def machine_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """--config, --emulate and --speed, which the command is given as `machine`."""

    @wraps(command)
    def on_machine(
        *args: Any, config: Path | None, emulate: Path | None, speed: float | None, **others: Any
    ) -> Any:
        return command(*args, machine=Machine(_read_settings(config, speed), emulate), **others)

    for option in (
        click.option(
            "--speed",
            type=click.FloatRange(0, 1000, min_open=True),
            help="Speed factor of the emulated machine.",
        ),
        click.option("--emulate", type=file_path, help="Rig file of the emulated machine."),
        click.option("--config", type=file_path, help="Station file.  [default: the emulated machine]"),
    ):
        on_machine = option(on_machine)
    return on_machine


def _read_settings(config: Path | None, speed: float | None) -> Settings:
    """The station file with the terminal's word on top.  :raises InputRefused:"""
    settings = load_settings(config)
    if speed is None:
        return settings
    return settings.model_copy(update={"emulated": settings.emulated.model_copy(update={"speed": speed})})


@contextmanager
def logging_to(home: Path, *, terminal: int) -> Iterator[None]:
    """Everything to a file in the home folder, what is at least `terminal` to standard error too.

    :raises InputRefused: the folder cannot be written.
    """
    try:
        home.mkdir(parents=True, exist_ok=True)
        file = RotatingFileHandler(home / "station.log", maxBytes=_LOG_BYTES, backupCount=_LOG_FILES)
    except OSError as error:
        raise InputRefused(f"The data folder {home} cannot be used: {error.strerror}.") from error
    screen = logging.StreamHandler()
    screen.setLevel(terminal)
    root = logging.getLogger()
    root.setLevel(logging.INFO)
    logging.getLogger("httpx2").setLevel(logging.WARNING)  # it logs whole addresses, with their tokens
    for handler in (file, screen):
        handler.setFormatter(_OneLine(_FORMAT))
        root.addHandler(handler)
    try:
        yield
    finally:
        for handler in (file, screen):
            root.removeHandler(handler)
            handler.close()
