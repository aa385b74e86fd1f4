"""A mechanism with effects added: the model, its fit, and the machine that it describes."""

from __future__ import annotations

from station.model.identified_machine import IdentifiedMachine, NotInvertible, Situation, identified
from station.model.model import Fit, Model, Term, fit, is_long

__all__ = [
    "Fit",
    "IdentifiedMachine",
    "Model",
    "NotInvertible",
    "Situation",
    "Term",
    "fit",
    "identified",
    "is_long",
]
