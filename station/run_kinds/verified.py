"""From readings to a verified result: identify, then fresh positions that are not used in the fit."""

from __future__ import annotations

from station.errors import InputRefused
from station.five_bar import Robot
from station.identification import (
    accuracy_of,
    advice_of,
    fresh_stops,
    not_identified,
    result_of,
    with_accuracy,
    without_jump,
)
from station.records import Beforehand, MeasurementSequence, Procedure, Reading
from station.run_kinds.fits import fit_of, with_memory_use


def identified_and_verified(
    robot: Robot,
    readings: list[Reading],
    memory: Beforehand | None,
    wanted_mm: float | None,
    *,
    advised: bool = True,
) -> Procedure:
    """The measurement model on readings, and a verdict from fresh ones.

    :param advised: whether to list measures that would improve the calibration
    """
    age_days = memory.age_days if memory else 0.0
    try:
        fit = fit_of(robot, readings, memory, age_days)
    except InputRefused as refusal:
        return without_jump(not_identified(str(refusal)), robot, readings)
    fresh: list[Reading] = yield MeasurementSequence(
        "Verifying at fresh positions", 2, fresh_stops(fit), last=True
    )
    result = result_of(fit, readings, fresh).model_copy(
        update={"lasting": fit.lasting.record(), "advice": advice_of(fit) if advised else ()}
    )
    result = without_jump(result, robot, [*readings, *fresh])
    result = with_accuracy(result, accuracy_of(fit, wanted_mm))
    return with_memory_use(result, fit.gate, memory, age_days)
