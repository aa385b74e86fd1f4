"""The `station` command.  Exit status: 0 done, 1 the run or verdict failed, 2 the input was refused."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import Any

import click

from station import __version__
from station.errors import InputRefused, NotApplicable, NotFound, StoreUnavailable
from station.home import station_home

_COMMANDS = {
    "audit": ("people", "Who did what; checks that the record is whole."),
    "apply": ("apply", "Write the zero offsets of a passed run to the drives and verify them."),
    "backup": ("archive", "A copy of the whole history in one new file, made while the station works."),
    "bench": ("bench", "Figures of speed and size, beside those of others where they are installed."),
    "calibrate": ("calibrate", "One calibration run, with live progress."),
    "certificate": ("certificate", "The certificate of a run, as HTML, PDF or JSON."),
    "columns": ("columns", "Propose a column map for a file of measurements made elsewhere."),
    "confusion": ("confusion", "The diagnosis judged on random emulated machines."),
    "diagnose": ("diagnosis", "Trace what the model leaves over to its cause."),
    "doctor": ("doctor", "Look at every device and its line, and say what to do; nothing moves."),
    "export": ("archive", "The readings of one run as a measurement file."),
    "gauge-study": ("gauge_study", "How much of the scatter of measured parts is the gauge."),
    "identify": ("identify", "Zero offsets with uncertainty from a measurement file."),
    "import": ("importing", "Keep a measurement file as a finished run, with its diagnosis."),
    "key": ("people", "API keys of programs, such as a MES."),
    "memory": ("history", "What a robot's next run knows of its geometry and mechanism."),
    "plan": ("plan", "The positions of a plan, their order and the accuracy they predict."),
    "quality": ("quality", "Capability, run rules and a Pareto of outcomes over finished runs."),
    "real-robot": ("real_robot", "The closed loop on logs of a real arm, as figures and drawings."),
    "refit": ("refit", "What today's software says of stored runs; nothing stored is changed."),
    "reproduce": ("reproduce", "The paper's tables and figures, computed again beside ours."),
    "replay": ("wire", "Carry out a run again from its wire log, without a machine, and compare."),
    "restore": ("restoring", "Put a backup in the place of the history; what was there is kept."),
    "retract": ("apply", "Bring the arm back into its workspace, slowly."),
    "robot": ("robot", "Write an arm's robot file from its URDF description."),
    "rollback": ("apply", "Put the zeros back that the drives had before a run was applied."),
    "runs": ("history", "The runs, newest first."),
    "serve": ("serve", "The service with the operator's page."),
    "show": ("history", "One run."),
    "simulate": ("simulate", "Years of a station in virtual time, with everything that can go wrong."),
    "solve": ("diagnosis", "Joint commands for target positions under the identified model."),
    "user": ("people", "People who sign in at the page."),
    "verify-certificate": ("certificate", "Whether a certificate says what was certified."),
    "verify": ("archive", "Whether every finished run is as it ended."),
    "wire": ("wire", "Every request and answer of one run, with its time, in plain words."),
    "study": ("study", "Many random machines, calibrated or diagnosed, and what came of it."),
    "translate": ("translate", "Taught joint positions under the zeros that the drives have now."),
    "transfer": ("diagnosis", "Apply the effects learned on one log, unchanged, to another log."),
}
"""Module and purpose of each command; imported when it is asked for, since the numerics take long to load."""


class Refusal(click.ClickException):
    """One line on standard error and exit status 2."""

    exit_code = 2

    def show(self, file: Any = None) -> None:
        click.echo(f"station: {' '.join(self.format_message().split())}", err=True)


class StationGroup(click.Group):
    """Whatever refuses the input, the person at the terminal reads one sentence."""

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
        help="Folder of database and logs; else STATION_HOME, else the platform's data folder.",
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
