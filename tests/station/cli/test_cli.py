"""The commands as a person or a script meets them: output, one-line refusals, exit status."""

from __future__ import annotations

import csv
import io
import json
import os
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from station.cli import main
from station.five_bar.robot_file import Robot
from station.records import Reading, State, because, readings_to_csv
from station.store.store import Store
from tests.station.asking import asked
from tests.station.fakes import result_of
from tests.station.run_kinds.test_diagnose import BACKLASH, machine, run

READING = Reading(1, 1.25, (0.5, 180.5), (1, -1), 12.3456, "p1", 1, (12.3456,))


def station(home: Path, *arguments: str) -> Result:
    return CliRunner().invoke(main, ["--home", str(home), *arguments])


@pytest.fixture
def home(tmp_path: Path) -> Path:
    """A history of three runs."""
    store = Store(tmp_path / "station.db")
    for serial, state in (("R1", State.SUCCEEDED), ("R2", State.ABORTED), ("R1", State.FAILED)):
        run = store.create(asked(serial, "paper"), Robot.default(serial))
        store.add_reading(run, READING)
        store.finish(
            run,
            state,
            result_of([READING]) if state is State.SUCCEEDED else None,
            because("stopped", by="ada"),
        )
    store.add_event(2, "stop", {"by": "ada"})
    store.close()
    return tmp_path


def test_runs_lists_the_newest_first(home: Path) -> None:
    output = station(home, "runs").output
    assert [line.split()[0] for line in output.splitlines() if "R" in line] == ["3", "2", "1"]
    assert "+0.5000" in output


def test_runs_as_csv_is_complete_and_filtered(home: Path) -> None:
    result = station(home, "runs", "--csv", "--serial", "R1", "--state", "succeeded")
    rows = list(csv.DictReader(io.StringIO(result.output)))
    assert [(row["id"], row["verdict"], row["dtheta2_deg"]) for row in rows] == [("1", "pass", "-0.5")]


def test_runs_without_any(tmp_path: Path) -> None:
    Store(tmp_path / "station.db").close()
    assert station(tmp_path, "runs").output == "No runs.\n"


def test_show_tells_one_run(home: Path) -> None:
    text = station(home, "show", "2").output
    assert "aborted" in text
    assert "{'by': 'ada'}" in text
    content = json.loads(station(home, "show", "1", "--json").output)
    assert content["zero_offsets"][0]["value_deg"] == 0.5
    assert content["readings"][0]["samples_mm"] == [12.3456]


def test_export_writes_the_measurement_file(home: Path) -> None:
    row = next(csv.DictReader(io.StringIO(station(home, "export", "1").output)))
    assert (row["reading"], float(row["scale_mm"]), row["approach2"]) == ("1", 12.3456, "-1")
    assert row["run_uid"] == json.loads(station(home, "show", "1", "--json").output)["uid"]


def test_a_table_of_runs_holds_no_formulas(tmp_path: Path) -> None:
    store = Store(tmp_path / "station.db")
    request = replace(asked("R1", "paper"), operator="=cmd()", work_order="@SUM(A1)")
    store.create(request, Robot.default("R1"))
    store.close()
    (row,) = csv.DictReader(io.StringIO(station(tmp_path, "runs", "--csv").output))
    assert (row["operator"], row["work_order"], row["id"]) == ("'=cmd()", "'@SUM(A1)", "1")


def test_import_keeps_a_file_as_a_run_and_a_robot_with_a_defect_is_no_pass(tmp_path: Path) -> None:
    readings, _ = run(machine(BACKLASH))
    sequence, fresh = (tmp_path / "walk.csv", tmp_path / "fresh.csv")
    for number, file in enumerate((sequence, fresh), start=1):
        file.write_text(readings_to_csv(r for r in readings if r.sequence == number))
    confirmed = station(tmp_path, "import", str(sequence), "--confirm", str(fresh), "--serial", "FB-5")
    assert (confirmed.exit_code, confirmed.stdout[:33]) == (1, "Run 1: fail. Backlash of joint 1 ")
    alone = station(tmp_path, "import", str(sequence), "--serial", "FB-5")
    assert alone.exit_code == 1
    assert "No fresh readings confirm it" in alone.output
    assert "dataset" in station(tmp_path, "show", "2").output


def test_a_backup_is_a_station_database_and_never_overwrites(home: Path, tmp_path: Path) -> None:
    target = tmp_path / "elsewhere" / "station.db"
    target.parent.mkdir()
    assert station(home, "backup", str(target)).exit_code == 0
    assert station(target.parent, "runs").output == station(home, "runs").output
    again = station(home, "backup", str(target))
    assert again.exit_code == 2
    assert "exists already" in again.stderr
    nowhere = station(home, "backup", str(tmp_path / "no" / "folder.db"))
    assert nowhere.exit_code == 2
    assert "cannot be written" in nowhere.stderr


@pytest.mark.parametrize(
    "arguments",
    [
        ("show", "99"),
        ("show", "x"),
        ("frobnicate",),
        ("runs", "--state", "napping"),
        ("import", "none.csv"),
        ("calibrate", "--plan", "guess"),
        ("calibrate", "--serial", ".."),
        ("calibrate", "--operator", "a\x1b[2J"),
        ("calibrate", "--config", "none.toml"),
        ("calibrate", "--robot", "none.toml"),
        ("calibrate", "--emulate", "none.toml"),
        ("serve", "--port", "99999"),
        ("--bogus",),
    ],
)
def test_a_refusal_is_one_line_and_status_2(tmp_path: Path, arguments: tuple[str, ...]) -> None:
    result = station(tmp_path, *arguments)
    assert result.exit_code == 2
    assert len(result.stderr.splitlines()) == 1
    assert result.stderr.startswith("station: ")
    assert result.stdout == ""


def test_the_serial_must_be_that_of_the_robot_file(tmp_path: Path) -> None:
    robot = tmp_path / "robot.toml"
    robot.write_text('[robot]\nserial = "R1"\n')
    result = station(tmp_path, "calibrate", "--robot", str(robot), "--serial", "R2")
    assert result.exit_code == 2
    assert "R2 is not the robot of" in result.stderr


# In processes of their own -----------------------------------------------------------------------


@contextmanager
def process(home: Path, *arguments: str) -> Iterator[subprocess.Popen[str]]:
    with subprocess.Popen(
        [sys.executable, "-m", "station", "--home", str(home), *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONUNBUFFERED": "1"},
    ) as child:
        try:
            yield child
        finally:
            child.kill()


NEW = "A new history begins at {}/station.db.\n"


def readline(child: subprocess.Popen[str]) -> str:
    assert child.stdout is not None
    return child.stdout.readline()


def test_calibrate_runs_on_the_emulated_rig_and_tells_the_result(tmp_path: Path) -> None:
    with process(tmp_path, "calibrate", "--serial", "R1", "--operator", "ada", "--speed", "200") as child:
        output, complaints = child.communicate(timeout=30)
    assert (child.returncode, complaints) == (0, NEW.format(tmp_path))
    lines = output.splitlines()
    assert lines[0] == "Measuring, pass 1"
    assert any(line.startswith("Run 1 PASS: ") for line in lines)
    assert any(line.startswith("  dtheta1 = ") for line in lines)


@pytest.mark.parametrize("sig", [signal.SIGINT, signal.SIGTERM])
def test_ctrl_c_stops_the_machine_and_stores_the_abort(tmp_path: Path, sig: signal.Signals) -> None:
    with process(tmp_path, "calibrate", "--operator", "ada", "--speed", "8") as child:
        while "P1" not in readline(child):
            assert child.poll() is None
        child.send_signal(sig)
        output, complaints = child.communicate(timeout=30)
    assert (child.returncode, complaints) == (1, NEW.format(tmp_path))
    assert "ABORTED: Stopped by the operator at the terminal." in output
    store = Store(tmp_path / "station.db")
    assert store.calibration(1).state == "aborted"
    assert len(store.readings(1)) >= 1
    store.close()


def test_kill_in_the_middle_of_a_real_run_keeps_its_readings(tmp_path: Path) -> None:
    with process(tmp_path, "calibrate", "--operator", "ada", "--speed", "8") as child:
        while "P2" not in readline(child):
            assert child.poll() is None
        child.kill()
        child.wait(10)
    with process(tmp_path, "calibrate", "--operator", "ada", "--speed", "200") as child:
        child.communicate(timeout=30)
    assert child.returncode == 0, "the rig of the killed process has let go"
    store = Store(tmp_path / "station.db")
    assert store.calibration(1).state == "interrupted"
    assert [r.position for r in store.readings(1)][:2] == ["P1", "P2"]
    assert store.calibration(2).verdict == "pass"
    store.close()


def test_serve_says_where_it_listens_and_ends_cleanly(tmp_path: Path) -> None:
    with process(tmp_path, "serve", "--port", "0") as child:
        line = readline(child)
        assert line.startswith("Station ready: http://127.0.0.1:")
        port = line.rsplit(":", 1)[1].strip()
        with process(tmp_path, "calibrate") as second:
            _, complaint = second.communicate(timeout=30)
        assert second.returncode == 2
        assert "holds the rig" in complaint
        with process(tmp_path, "serve", "--port", port) as third:
            _, complaint = third.communicate(timeout=30)
        assert third.returncode == 2
        assert f"Cannot listen on 127.0.0.1:{port}: Address already in use." in complaint
        with socket.create_connection(("127.0.0.1", int(port)), timeout=5) as connection:
            connection.sendall(b"GET /healthz HTTP/1.0\r\n\r\n")
            assert connection.recv(100).startswith(b"HTTP/1.1 200")
        child.send_signal(signal.SIGTERM)
        child.communicate(timeout=20)
        assert child.returncode == 0
