"""The `station` command.  Exit status: 0 done, 1 the run or verdict failed, 2 the input was refused."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import Any

import click

from station import __version__
from station.errors import InputRefused, NotFound
from station.settings import station_home

_MODULES = {
    "apply": "apply",
    "backup": "archive",
    "bench": "studies",
    "calibrate": "calibrate",
    "confusion": "confusion",
    "diagnose": "diagnosis",
    "export": "archive",
    "identify": "numerics",
    "import": "importing",
    "memory": "history",
    "plan": "numerics",
    "real-robot": "real_robot",
    "reproduce": "studies",
    "rollback": "apply",
    "runs": "history",
    "serve": "serve",
    "show": "history",
    "solve": "diagnosis",
    "transfer": "diagnosis",
}
"""Where each command is; imported when it is asked for, since the numerics take a second to load."""


class Refusal(click.ClickException):
    """One line on standard error and exit status 2."""

    exit_code = 2

    def show(self, file: Any = None) -> None:
        click.echo(f"station: {' '.join(self.format_message().split())}", err=True)


class StationGroup(click.Group):
    """Whatever refuses the input, the person at the terminal reads one sentence."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return sorted(_MODULES)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in _MODULES:
            return None
        module = import_module(f"{__name__}.{_MODULES[cmd_name]}")
        command: click.Command = getattr(module, f"{cmd_name.replace('-', '_')}_command")
        return command

    def make_context(self, *args: Any, **extra: Any) -> click.Context:
        try:
            return super().make_context(*args, **extra)
        except click.UsageError as error:
            raise _refusal(error) from error

    def invoke(self, ctx: click.Context) -> Any:
        try:
            return super().invoke(ctx)
        except (click.UsageError, InputRefused, NotFound) as error:
            raise _refusal(error) from error


def _refusal(error: Exception) -> click.ClickException:
    if isinstance(error, click.exceptions.NoArgsIsHelpError):
        return error  # its text is the help page
    return Refusal(error.format_message() if isinstance(error, click.UsageError) else str(error))


@click.group(cls=StationGroup)
@click.version_option(__version__)
@click.option(
    "--home",
    type=click.Path(file_okay=False, path_type=Path),
    help="Folder of database and logs; else STATION_HOME, else the platform's data folder.",
)
@click.pass_context
def main(context: click.Context, home: Path | None) -> None:
    """Calibrate the zero offsets of a five-bar robot."""
    context.obj = station_home(home)
