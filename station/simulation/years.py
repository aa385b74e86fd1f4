"""Months and years of a station, and their results."""

from __future__ import annotations

import importlib
import logging
import pkgutil
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

from drivers.emulated.spec import MachineSpec
from station.five_bar import Robot
from station.simulation.days import DEEDS, TROUBLES, Days
from station.simulation.jobs import WHOLE, Job, Script
from station.simulation.keeper import Keeper, Stranded
from station.simulation.plant import Plant
from station.simulation.site import Site
from station.simulation.witness import Violation, Witness

MONTHS_A_YEAR = 12
DAYS_A_MONTH = 30
_ROBOTS = 3
_TOLERANCE_MM = 0.03
_MOUNTING_MM = 0.3
_PACKAGES = ("station.service", "station.run_kinds", "station.diagnosis", "station.outbox", "station.store")


@dataclass(frozen=True, slots=True)
class Life:
    """The result of some days of one station."""

    seed: int
    days: int
    runs: int
    readings: int
    restarts: int
    happened: dict[str, int]
    """Count of each action and disturbance."""
    digest: str
    """SHA-256 of all data that the page showed and the history stored."""
    jobs: tuple[Job, ...]
    violations: tuple[Violation, ...]


def months(years: float, seed: int) -> list[int]:
    """Seeds of the months.  A year is twelve stations of a month each, so that all cores work on it."""
    count = max(1, round(years * MONTHS_A_YEAR))
    return [seed * 1_000_000 + month for month in range(count)]


def month(seed: int) -> Life:
    """One station over a month; it ends early after a violation."""
    return live(seed, DAYS_A_MONTH)


def live(
    seed: int,
    days: int,
    deeds: Mapping[str, float] = DEEDS,
    troubles: Mapping[str, float] = TROUBLES,
    script: Script = WHOLE,
) -> Life:
    """One station over some days: the same seed gives the same days.

    :param deeds: frequency of each request; :param troubles: frequency of each disturbance
    :param script: selection of the drawn jobs to carry out
    """
    random = Random(seed)
    with TemporaryDirectory() as folder, prepared():
        machines = [_machine(random) for _ in range(_ROBOTS)]
        plant = Plant(Path(folder) / "home", machines, random, Site.drawn(random))
        keeper = Keeper(plant, Witness(plant))
        life = Days(keeper, f"{seed}", deeds, troubles, script)
        lived = 0
        with plant.entered():
            while lived < days and not keeper.witness.violations:
                try:
                    life.day()
                except Stranded:
                    break
                lived += 1
            plant.scheduler.end()
    witness = keeper.witness
    return Life(
        seed=seed,
        days=lived,
        runs=witness.runs,
        readings=witness.readings,
        restarts=keeper.restarts,
        happened=dict(sorted(life.happened.items())),
        digest=witness.digest,
        jobs=tuple(life.jobs),
        violations=tuple(witness.violations),
    )


def happenings(lives: Sequence[Life]) -> Counter[str]:
    """Count of each action and disturbance in all of them."""
    return sum((Counter(life.happened) for life in lives), Counter())


def _machine(random: Random) -> MachineSpec:
    """A machine within the station's tolerances, with shifted zeros."""

    nominal = Robot.default()

    def error_mm() -> float:
        return random.gauss(0.0, _TOLERANCE_MM)

    return MachineSpec(
        seed=random.randrange(2**31),
        zero_offsets_deg=(random.gauss(0.0, 0.6), random.gauss(0.0, 0.6)),
        L_error_mm=(error_mm(), error_mm()),
        l_error_mm=(error_mm(), error_mm()),
        e_error_mm=(error_mm(), error_mm(), error_mm(), error_mm()),
        drm_mm=(random.gauss(nominal.drm[0], _MOUNTING_MM), random.gauss(nominal.drm[1], _MOUNTING_MM)),
    )


@contextmanager
def prepared() -> Iterator[None]:
    """Load all modules, and silence the station's log, which would contain every fault."""
    _load()
    logging.disable(logging.CRITICAL)
    try:
        yield
    finally:
        logging.disable(logging.NOTSET)


def _load() -> None:
    """Every production module, so that none is loaded later with the real clock in it."""
    for name in _PACKAGES:
        package = importlib.import_module(name)
        for found in pkgutil.walk_packages(package.__path__, f"{name}."):
            importlib.import_module(found.name)
