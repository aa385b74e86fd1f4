"""Long histories for measurements are ones that the station itself could have stored."""

from __future__ import annotations

from pathlib import Path

from click.testing import CliRunner

from station.store import Store
from station.studies.scale.__main__ import main


def command(*args: str) -> str:
    said = CliRunner(catch_exceptions=False).invoke(main, args)
    assert said.exit_code == 0, said.output
    return said.output.strip()


def test_simulated_runs_are_stored_and_copied_with_all_that_they_left(tmp_path: Path) -> None:
    file = tmp_path / "station.db"
    for kind, seed in (("calibrate", "1"), ("diagnose", "5")):
        said = command("simulate", str(file), kind, "--runs", "1", "--seed", seed, "--workers", "1")
        assert said == "1 of 1 runs were stored."
    command("lengthen", str(file), "--runs", "4", "--readings")
    command("lengthen", str(file), "--runs", "5")
    store = Store(file)
    first, second, third, fourth, fifth = store.calibrations(order="oldest").items
    assert [run.kind for run in (first, second, third, fourth)] == ["calibrate", "diagnose"] * 2
    assert (first.outcome, third.outcome, third.zero_offsets) == ("good", "good", first.zero_offsets)
    assert store.readings(4) == store.readings(2) and len(store.readings(4)) == 160
    assert store.readings(3) == store.readings(1) and store.readings(5) == []
    assert store.calibration(4).findings == store.calibration(2).findings != ()
    (columns,) = store.table("findings", 1, 5)
    assert columns["run_id"].count(4) == columns["run_id"].count(2) > 0
    assert len({run.uid for run in (first, second, third, fourth, fifth)}) == 5
    assert fifth.created_at > fourth.created_at > third.created_at > second.created_at
    store.close()
