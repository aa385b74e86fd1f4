"""Mistakes in a file or a robot file, each tried as an explanation of readings that do not agree.

`find_mistake` is the only entry point. `mistake` defines a mistake; `fitting` fits the base model under a
hypothesis; `defects` are the explanations without a mistake that a mistake has to exceed; `corrections` undo
one mistake each, and `gross` finds the one that helps, on all rows or on a run of them; `entries` are wrong
numbers in the robot file and steps in between; `duplicates`, `resolution` and `labels` check the columns
themselves; `fresh` compares fresh readings with the sequence; `glitches` are isolated readings far off.
"""

from __future__ import annotations

from station.diagnosis.mistakes.fitting import fit as fit_readings
from station.diagnosis.mistakes.mistake import Context, Kind, Mistake, MistakeRefused, Severity
from station.diagnosis.mistakes.search import find_mistake

__all__ = ["Context", "Kind", "Mistake", "MistakeRefused", "Severity", "find_mistake", "fit_readings"]
