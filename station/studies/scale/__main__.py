"""`python -m station.studies.scale`: large histories, and how quick the station is with them."""

from __future__ import annotations

from contextlib import closing
from pathlib import Path

import click
from rich.console import Console

from station.store import Store
from station.studies.engine import Engine
from station.studies.long_history import lengthen
from station.studies.options import resume_option, seed_option, workers_option
from station.studies.scale.pages import answered
from station.studies.scale.simulated_runs import MAKE, Kind, add_simulated


@click.group()
def main() -> None:
    """Make a history, then measure."""


@main.command("simulate")
@click.argument("database", type=click.Path(dir_okay=False, path_type=Path))
@click.argument("kind", type=click.Choice(list(MAKE)))
@click.option("--runs", type=click.IntRange(1), required=True)
@click.option("--robots", type=click.IntRange(1), default=500, show_default=True)
@seed_option
@workers_option
@resume_option
def simulate(
    database: Path, kind: Kind, runs: int, robots: int, seed: int, workers: int | None, resume: Path | None
) -> None:
    """Runs on simulated machines, added to DATABASE."""
    with closing(Store(database)) as store:
        stored = add_simulated(store, kind, runs, robots, seed, Engine(Console(stderr=True), workers, resume))
    click.echo(f"{stored} of {runs} runs were stored.")


@main.command("lengthen")
@click.argument("database", type=click.Path(exists=True, dir_okay=False, path_type=Path))
@click.option("--runs", type=click.IntRange(1), required=True, help="How many there are to be.")
@click.option("--readings", is_flag=True, help="With their readings.")
def lengthen_command(database: Path, runs: int, readings: bool) -> None:
    """Copy the runs of DATABASE, one a minute, to other robots."""
    lengthen(database, runs, readings=readings)


@main.command("pages")
@click.argument("home", type=click.Path(exists=True, file_okay=False, path_type=Path))
@click.option("--times", type=click.IntRange(1), default=20, show_default=True)
def pages(home: Path, times: int) -> None:
    """Serve HOME on instant devices, and time what its pages ask for."""
    for path, by_clock, of_processor in answered(home, times):
        click.echo(f"{path:50} {by_clock:7.1f} ms, {of_processor:6.1f} ms of processor time")


@main.command("cluster")
@click.option("--machines", type=click.IntRange(1), required=True)
@seed_option
@click.option("--after", default=5.0, show_default=True, help="Seconds until a worker is killed.")
def cluster(machines: int, seed: int, after: float) -> None:
    """Study accuracy on a Dask cluster of two workers, one killed: the digest of `station study accuracy`."""
    from station.studies.scale.cluster import digest_after_a_loss  # Dask is an extra

    found, killed = digest_after_a_loss(machines, seed, after)
    click.echo(f"{machines} machines; digest {found}; a worker was {'lost' if killed else 'NOT lost'}")


if __name__ == "__main__":
    main()
