"""Execution of a procedure, step by step."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from drivers.errors import DeviceError
from station.errors import StepFailed
from station.records import CalibrationResult, Procedure, Step


def follow_procedure(procedure: Procedure, carry_out: Callable[[Step], Any]) -> CalibrationResult:
    """Execute all steps up to the result.

    The error of a step is raised in the procedure, which may recover from it.
    """
    try:
        step = next(procedure)
        while True:
            try:
                answer = carry_out(step)
            except (DeviceError, StepFailed) as error:
                step = procedure.throw(error)
            else:
                step = procedure.send(answer)
    except StopIteration as end:
        result: CalibrationResult = end.value
        return result
