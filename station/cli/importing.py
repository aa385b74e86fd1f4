"""`station import`: a measurement file into the history, diagnosed, while the service runs or not."""

from __future__ import annotations

import getpass
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import click

from station.cli.files import columns_option, file_path, measured_option
from station.cli.kept import config_option, new_history
from station.errors import InputRefused, NotFound
from station.five_bar import Robot
from station.machines import AnyRobot, read_robot, robot_of
from station.records import (
    FIVE_BAR,
    CalibrationRequest,
    ColumnMap,
    KeptLog,
    LogPart,
    Measured,
    checked_name,
    checked_serial,
    content_of,
    translated,
)
from station.run_kinds import ArmLog, Upload, import_dataset, import_log
from station.serial_arm import Arm
from station.settings import database_path, load_settings
from station.store import Store


@click.command("import")
@click.argument("data", type=file_path)
@click.option("--confirm", "fresh_file", type=file_path, help="Fresh readings to confirm the cause with.")
@click.option("--robot", "robot_file", type=file_path, help="Robot file; by default the one kept.")
@click.option("--serial", help="Robot that was measured; by default that of the robot file.")
@click.option("--hold-out", is_flag=True, help="Judge an arm's log by a quarter of it, held out.")
@measured_option
@columns_option
@click.option("--operator", default=getpass.getuser, help="Who imports; default: who is logged in.")
@config_option
@click.pass_context
def import_command(
    context: click.Context,
    data: Path,
    fresh_file: Path | None,
    robot_file: Path | None,
    serial: str | None,
    hold_out: bool,
    measured: Measured,
    mapping: ColumnMap | None,
    operator: str,
    config: Path | None,
) -> None:
    """Keep a measurement file as a finished run and trace what the model leaves over to its cause.

    Exit status 0: fresh readings confirm the model; 1: they do not, or there are none.
    """
    given = None if robot_file is None else read_robot(robot_file)
    serial = checked_serial(serial or (given or Robot.default()).serial)
    request = CalibrationRequest(serial, "import", checked_name(operator))
    file = _kept("file", data, mapping, measured)
    fresh = None if fresh_file is None else _kept("fresh", fresh_file, mapping, measured)
    path = database_path(load_settings(config), context.obj)
    new = new_history(path)
    with closing(Store(path)) as store:
        robot = _robot(store, given, serial)
        if isinstance(robot, Arm):
            submitted = import_log(store, request, ArmLog(robot, file, fresh, hold_out))
        else:
            if hold_out:
                raise click.UsageError("--hold-out is for logs of arms; a five-bar needs fresh readings.")
            judging = None if fresh is None else _upload(fresh, mapping)
            submitted = import_dataset(store, request, _upload(file, mapping), judging, robot=robot)
        run = store.summary(submitted.id)
    if new:
        click.echo(new, err=True)
    click.echo(f"Run {run.id}: {run.verdict}. {run.reason}")
    context.exit(0 if run.verdict == "pass" else 1)


def _robot(store: Store, given: AnyRobot | None, serial: str) -> Arm | Robot:
    """As given, else as kept, else the paper's five-bar; always of this serial.

    :raises InputRefused: a kind of machine whose logs are not kept.
    """
    if given is None:
        try:
            given = robot_of(store.robot_file(serial), source=f"robot {serial}")
        except NotFound:
            given = Robot.default(serial)
    if not isinstance(given, Arm | Robot):
        raise InputRefused(
            f"The history keeps logs of five-bars and serial arms, not of the model {given.model}; "
            "use `station diagnose`."
        )
    return replace(given, serial=serial)


def _kept(part: LogPart, file: Path, mapping: ColumnMap | None, measured: Measured) -> KeptLog:
    columns = "" if mapping is None else mapping.model_dump_json(exclude_defaults=True)
    return KeptLog(part, file.name, content_of(file), columns, measured)


def _upload(file: KeptLog, mapping: ColumnMap | None) -> Upload:
    if mapping is None:
        return Upload(file.name, file.content)
    return Upload(file.name, translated(file.content, mapping, FIVE_BAR, file.name).content)
