"""Experiments that are said to decide between explanations, carried out on random machines."""

from __future__ import annotations

from station.studies.experiments.one import experiments
from station.studies.experiments.summary import figures

__all__ = ["experiments", "figures"]
