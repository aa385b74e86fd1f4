"""`station calibrate`: one run from the terminal, live progress, Ctrl-C stops the machine first."""

from __future__ import annotations

import getpass
import logging
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import click
from rich.console import Console

from station.cli.machine_options import logging_to, machine_options, read_settings
from station.cli.progress import progress
from station.records import CalibrationRequest, PlanName, State
from station.robot import Robot
from station.runtime import Runtime

_STOP_LIMIT_S = 15.0


@click.command("calibrate")
@click.option("--plan", type=click.Choice(["paper", "rapid", "full"]), default="paper", show_default=True)
@click.option("--serial", help="Of the robot; else the robot file's.")
@click.option("--robot", "robot_file", type=click.Path(path_type=Path), help="Robot file, kept from then on.")
@click.option("--operator", help="Who is responsible; else the user of this terminal.")
@click.option("--work-order", help="Kept with the run.")
@machine_options
@click.pass_obj
def calibrate_command(
    home: Path,
    plan: PlanName,
    serial: str | None,
    robot_file: Path | None,
    operator: str | None,
    work_order: str | None,
    config: Path | None,
    emulate: Path | None,
    speed: float | None,
) -> None:
    """One calibration run, with live progress."""
    settings = read_settings(config, speed)
    robot = Robot.from_toml(robot_file) if robot_file else Robot.default()
    if robot_file and serial not in (None, robot.serial):
        raise click.UsageError(
            f"--serial {serial} is not the robot of {robot_file}, which is {robot.serial}."
        )
    logs = logging_to(home, terminal=logging.ERROR)
    with _interruptible(), logs, Runtime.open(settings, home, emulate) as runtime:
        if robot_file:
            runtime.store.save_robot(robot)
        request = CalibrationRequest(serial or robot.serial, plan, operator or getpass.getuser(), work_order)
        console = Console(highlight=False)
        with progress(console, runtime.orchestrator):
            calibration_id = runtime.orchestrator.submit(request).id
            state = _end_of(runtime, calibration_id)
        calibration = runtime.store.calibration(calibration_id)
    _print_outcome(console, state, calibration)
    sys.exit(0 if calibration["verdict"] == "pass" else 1)


def _end_of(runtime: Runtime, calibration_id: int) -> State:
    try:
        return runtime.orchestrator.wait(calibration_id)
    except KeyboardInterrupt:
        runtime.orchestrator.stop("the operator at the terminal")
        return runtime.orchestrator.wait(calibration_id, _STOP_LIMIT_S)


@contextmanager
def _interruptible() -> Iterator[None]:
    """An end asked for from outside takes the same way as Ctrl-C: stop, store, release."""
    before = {sig: signal.signal(sig, signal.default_int_handler) for sig in (signal.SIGTERM, signal.SIGHUP)}
    try:
        yield
    finally:
        for sig, handler in before.items():
            signal.signal(sig, handler)


def _print_outcome(console: Console, state: State, calibration: dict[str, Any]) -> None:
    verdict = (calibration["verdict"] or str(state)).upper()
    console.print(f"Run {calibration['id']} {verdict}: {calibration['reason']}", soft_wrap=True)
    for zero in calibration["zero_offsets"]:
        console.print(f"  dtheta{zero['joint']} = {zero['value_deg']:+.4f} deg, sd {zero['sd_deg']:.4f}")
    if weak := calibration["weak_direction"]:
        console.print(f"  weakest: {weak['text']}", soft_wrap=True)
