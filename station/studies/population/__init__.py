"""A population of machines, each calibrated as the station does it: accuracy, coverage, capability."""

from __future__ import annotations

from station.studies.population.figures import FIGURES
from station.studies.population.one import Case, calibrated, population
from station.studies.population.physics import PlainMachine

__all__ = ["FIGURES", "Case", "PlainMachine", "calibrated", "population"]
