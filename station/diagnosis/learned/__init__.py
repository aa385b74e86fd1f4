"""The result of a diagnosis, stored and used: model file, commands, and its effects on another log."""

from __future__ import annotations

from station.diagnosis.learned.commands import range_said, solve_targets
from station.diagnosis.learned.mixture_file import mixture_document
from station.diagnosis.learned.model_file import learned_model, model_document, read_model, read_part
from station.diagnosis.learned.other_log import Transfer, transfer
from station.diagnosis.learned.targets import TargetRefused, commands_csv, read_targets, targets_of

__all__ = [
    "TargetRefused",
    "Transfer",
    "commands_csv",
    "learned_model",
    "mixture_document",
    "model_document",
    "range_said",
    "read_model",
    "read_part",
    "read_targets",
    "solve_targets",
    "targets_of",
    "transfer",
]
