"""The steps of a run, as a generator."""

from __future__ import annotations

from collections.abc import Generator
from typing import Any

from station.records.result import CalibrationResult
from station.records.run import Step

Procedure = Generator[Step, Any, CalibrationResult]
"""Yields steps and receives the result of each: readings of a sequence, shifts of zeros, the distance back.

An error in a step is raised where it was yielded, so that the procedure may still recover. A procedure never
uses a device: the orchestrator moves, stores and sends.
"""
