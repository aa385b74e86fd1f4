"""The `station` command.  Exit status: 0 success, 1 the run or verdict failed, 2 the input was refused."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import Any

import click

from station import __version__
from station.errors import InputRefused, NotApplicable, NotFound, StoreUnavailable
from station.home import station_home

_COMMANDS = {
    "audit": ("people", "Show the audit, newest entry first, and check its chain."),
    "apply": ("apply", "Write the zero offsets of a passed run to the drives and verify them."),
    "backup": ("archive", "Copy the whole history to a new file, also while the service runs."),
    "bench": ("bench", "Measure speed and size, and compare them with other programs."),
    "calibrate": ("calibrate", "Carry out one calibration run, with live progress."),
    "certificate": ("certificate", "Write the certificate of a run as HTML, PDF or JSON."),
    "columns": ("columns", "Propose a column map for a measurement file from other software."),
    "confusion": ("confusion", "Test the diagnosis on random emulated machines."),
    "diagnose": ("diagnosis", "Find the causes of the residual of a measurement file."),
    "doctor": ("doctor", "Examine every device and its line without motion, and list remedies."),
    "export": (
        "archive",
        "Write the readings of a run as a measurement file, or the history as Parquet files.",
    ),
    "gauge-study": ("gauge_study", "Compute how much of the scatter is caused by the gauge."),
    "identify": ("identify", "Compute zero offsets with uncertainty from a measurement file."),
    "import": ("importing", "Store a measurement file as a finished run and diagnose it."),
    "key": ("people", "Manage API keys of programs, and print the public key of the certificates."),
    "memory": ("history", "Show or clear what the next run of a robot knows from earlier runs."),
    "plan": ("plan", "Show the positions of a plan, their order and the predicted accuracy."),
    "quality": ("quality", "Show capability, run rules and a Pareto chart of outcomes of finished runs."),
    "real-robot": ("real_robot", "Diagnose logs of a real arm and write figures and drawings."),
    "refit": ("refit", "Fit stored runs again with the present software and show the differences."),
    "reproduce": ("reproduce", "Compute the tables and figures of the paper again."),
    "replay": ("wire", "Carry out a run again from its wire log, without a machine, and compare."),
    "restore": ("restoring", "Replace the history by a backup; the previous history is kept."),
    "retract": ("apply", "Bring the arm back into its workspace, slowly."),
    "robot": ("robot", "Write the robot file of an arm from its URDF description."),
    "rollback": ("apply", "Restore the zeros that the drives had before a run was applied."),
    "runs": ("history", "List the runs, newest first."),
    "serve": ("serve", "Start the service with the operator's page."),
    "show": ("history", "Show one run."),
    "simulate": ("simulate", "Simulate years of a station in virtual time, with faults."),
    "solve": ("diagnosis", "Compute joint commands for target positions with an identified model."),
    "user": ("people", "Manage the users who sign in on the page."),
    "verify-certificate": ("certificate", "Check whether a certificate was changed."),
    "verify": ("archive", "Check that no finished run was changed."),
    "wire": ("wire", "Show every request and answer of one run, with its time, in words."),
    "study": ("study", "Calibrate or diagnose many random machines and summarise the results."),
    "translate": ("translate", "Convert taught joint positions to the present zeros."),
    "transfer": ("diagnosis", "Apply the effects learned on one log, unchanged, to another log."),
}
"""Module and purpose of each command; the module is imported when it is needed: the numerics load slowly."""


class Refusal(click.ClickException):
    """One line on standard error and exit status 2."""

    exit_code = 2

    def show(self, file: Any = None) -> None:
        click.echo(f"station: {' '.join(self.format_message().split())}", err=True)


class StationGroup(click.Group):
    """Any refusal of the input is shown as one sentence on the terminal."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return sorted(_COMMANDS)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        with formatter.section("Commands"):
            formatter.write_dl([(name, _COMMANDS[name][1]) for name in self.list_commands(ctx)])

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in _COMMANDS:
            return None
        module = import_module(f"{__name__}.{_COMMANDS[cmd_name][0]}")
        command: click.Command = getattr(module, f"{cmd_name.replace('-', '_')}_command")
        _with_home(command)
        return command

    def make_context(self, *args: Any, **extra: Any) -> click.Context:
        try:
            return super().make_context(*args, **extra)
        except click.UsageError as error:
            raise _refusal(error) from error

    def invoke(self, ctx: click.Context) -> Any:
        try:
            return super().invoke(ctx)
        except (click.UsageError, InputRefused, NotApplicable, NotFound, StoreUnavailable) as error:
            raise _refusal(error) from error


def _refusal(error: Exception) -> click.ClickException:
    if isinstance(error, click.exceptions.NoArgsIsHelpError):
        return error  # its text is the help page
    return Refusal(error.format_message() if isinstance(error, click.UsageError) else str(error))


def _home(**how: Any) -> click.Option:
    return click.Option(
        ["--home"],
        type=click.Path(file_okay=False, path_type=Path),
        help="Folder of database and logs.  [default: STATION_HOME, else the data folder of the platform]",
        **how,
    )


def _with_home(command: click.Command) -> None:
    """--home after the command's name, too, and after that of its part."""
    if not any(option.name == "home" for option in command.params):
        command.params.append(_home(expose_value=False, callback=_set_home))
    if isinstance(command, click.Group):
        for part in command.commands.values():
            _with_home(part)


def _set_home(context: click.Context, _option: click.Parameter, home: Path | None) -> None:
    """After the command's name, too."""
    if home is not None:
        context.obj = station_home(home)


@click.group(cls=StationGroup)
@click.version_option(__version__)
@click.pass_context
def main(context: click.Context, home: Path | None) -> None:
    """Calibrate the zero offsets of a five-bar robot."""
    context.obj = station_home(home)


main.params.append(_home())
