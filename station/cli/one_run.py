"""One run from the terminal: live progress, Ctrl-C stops the machine first, exit status by verdict."""

from __future__ import annotations

import getpass
import logging
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NoReturn

import click
from rich.console import Console

from station.cli.kept import new_history
from station.cli.machine_options import Machine, logging_to
from station.cli.progress import progress
from station.errors import FieldRefused, NotApplicable
from station.records import Calibration, Prompt, State
from station.service import Runtime, Submitted
from station.settings import database_path

_STOP_LIMIT_S = 15.0
_LOOK_S = 0.2


def _who(_context: click.Context, _option: click.Parameter, name: str | None) -> str:
    return name or getpass.getuser()


operator_option = click.option(
    "--operator", callback=_who, help="Name of the operator.  [default: the user of the terminal]"
)


def one_run(home: Path, machine: Machine, submit: Callable[[Runtime], Submitted]) -> NoReturn:
    """Take the rig, submit, wait for the end, say how it ended; exits with 0 for a good outcome, else 1.

    :raises InputRefused: the station cannot be opened or refuses the run.
    :raises click.UsageError: the offsets it is about cannot be written or taken back.
    """
    new = new_history(database_path(machine.settings, home))
    logs = logging_to(home, terminal=logging.ERROR)
    with _interruptible(), logs, Runtime.open(machine.settings, home, machine.emulate) as runtime:
        console = Console(highlight=False)
        if new:
            click.echo(new, err=True)
        with progress(console, runtime.orchestrator):
            try:
                calibration_id = submit(runtime).id
            except NotApplicable as refusal:
                raise click.UsageError(str(refusal)) from refusal
            state = _end_of(runtime, calibration_id, console)
        calibration = runtime.store.calibration(calibration_id)
    _print_outcome(console, state, calibration)
    done = calibration.verdict == "pass" or (calibration.verdict is None and calibration.outcome == "good")
    sys.exit(0 if done else 1)


def _end_of(runtime: Runtime, calibration_id: int, console: Console) -> State:
    orchestrator = runtime.orchestrator
    try:
        while not (state := orchestrator.wait(calibration_id, _LOOK_S)).ended:
            if prompt := orchestrator.prompt(calibration_id):
                _answer(runtime, calibration_id, prompt, console)
        return state
    except (KeyboardInterrupt, click.Abort):
        runtime.orchestrator.stop("the operator at the terminal")
        return runtime.orchestrator.wait(calibration_id, _STOP_LIMIT_S)


def _answer(runtime: Runtime, calibration_id: int, prompt: Prompt, console: Console) -> None:
    """Ask at the terminal what the run asks."""
    console.print(prompt.text, markup=False, soft_wrap=True)
    value = click.prompt(prompt.unit or "value", type=float) if prompt.kind == "number" else None
    if prompt.kind == "confirm":
        click.prompt("Press Enter when done", default="", show_default=False)
    try:
        runtime.orchestrator.answer(calibration_id, prompt.id, value, "the terminal")
    except (FieldRefused, NotApplicable) as refusal:
        console.print(str(refusal), markup=False)


@contextmanager
def _interruptible() -> Iterator[None]:
    """An end asked for from outside takes the same way as Ctrl-C: stop, store, release."""
    before = {sig: signal.signal(sig, signal.default_int_handler) for sig in (signal.SIGTERM, signal.SIGHUP)}
    try:
        yield
    finally:
        for sig, handler in before.items():
            signal.signal(sig, handler)


def _print_outcome(console: Console, state: State, calibration: Calibration) -> None:
    verdict = (calibration.verdict or str(state)).upper()
    console.print(f"Run {calibration.id} {verdict}: {calibration.reason}", soft_wrap=True)
    for zero in calibration.zero_offsets:
        console.print(f"  dtheta{zero.joint} = {zero.value_deg or 0.0:+.4f} deg, sd {zero.sd_deg or 0.0:.4f}")
    if weak := calibration.weak_direction:
        console.print(f"  weakest: {weak.text}", soft_wrap=True)
