"""The command line as a whole: what it lists, how little it loads, where it looks for the history."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import click
import pytest
from click.testing import CliRunner

from station.cli import StationGroup, main
from station.store.store import Store

COMMANDS = sorted(main.list_commands(click.Context(main)))


def test_help_loads_no_numerics() -> None:
    code = (
        "import sys\nfrom station.cli import main\n"
        "try:\n    main(['--help'], prog_name='station')\nexcept SystemExit:\n    pass\n"
        "heavy = {'numpy', 'scipy', 'pydantic', 'fastapi'}\n"
        "print(sorted({name.split('.')[0] for name in sys.modules} & heavy))"
    )
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert said.splitlines()[-1] == "[]"


def test_identify_loads_no_statistics_package() -> None:
    code = "import sys, station.cli.identify; print('scipy.stats' in sys.modules, 'fastapi' in sys.modules)"
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert said.strip() == "False False"


@pytest.mark.parametrize("name", COMMANDS)
def test_every_listed_command_is_there_and_has_help(name: str) -> None:
    assert isinstance(main, StationGroup)
    command = main.get_command(click.Context(main), name)
    assert command is not None and command.help


@pytest.mark.parametrize("place", ["before", "after"])
def test_home_works_before_and_after_the_command(tmp_path: Path, place: str) -> None:
    Store(tmp_path / "station.db").close()
    home = ["--home", str(tmp_path)]
    said = CliRunner().invoke(main, [*home, "runs"] if place == "before" else ["runs", *home])
    assert (said.exit_code, said.output) == (0, "No runs.\n")


@pytest.mark.parametrize(
    "command", [["runs"], ["show", "1"], ["memory", "R1"], ["export", "1"], ["backup", "b.db"]]
)
def test_a_mistyped_folder_begins_no_history(tmp_path: Path, command: list[str]) -> None:
    home = tmp_path / "mistyped"
    said = CliRunner().invoke(main, [*command, "--home", str(home)])
    assert said.exit_code == 2
    assert "There is no history at" in said.output
    assert not home.exists()
