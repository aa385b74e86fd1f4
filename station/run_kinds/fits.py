"""Readings of a run fitted together with the knowledge from earlier runs: during the run and afterwards."""

from __future__ import annotations

import numpy as np

from station.five_bar import FiveBar, Robot
from station.identification import Gate, Identification, Memory, gate_record, identify
from station.records import (
    Beforehand,
    CalibrationResult,
    FleetPrior,
    FleetUse,
    MemoryUse,
    Reading,
    Real,
    from_readings,
)

DAYS_PER_YEAR = 365.25
UNKNOWN_OFFSET_MM = 1e4


def aged(memory: Beforehand, robot: Robot, age_days: float) -> Memory:
    """The prior knowledge of a run; the uncertainty of the memory grows with its age."""
    if isinstance(memory, FleetPrior):
        return Memory.of_fleet(memory)
    mechanism = FiveBar(robot, from_readings([]))
    return Memory.of(memory.memory).aged(mechanism.parameters, age_days / DAYS_PER_YEAR)


def fit_of(
    robot: Robot, readings: list[Reading], memory: Beforehand | None, age_days: float
) -> Identification[FiveBar]:
    """The measurement model on readings, with the memory at that age.

    Where the mechanism was moved between the readings, the memory of its mounting is not used.

    :raises InputRefused: as `identify`.
    """
    known = None if memory is None else aged(memory, robot, age_days)
    if known is not None and any(reading.mount for reading in readings):
        known = known.about([name for name in known.names if not name.startswith(("rMx", "rMy"))])
    return identify(robot, from_readings(readings), known)


def wandered(fit: Identification[FiveBar], age_days: float) -> Real:
    """(P, P) covariance of a fit of that age; the readout's offsets are unknown again."""
    parameters = fit.mechanism.parameters
    names = [p.name for p in parameters]
    covariance = fit.covariance.copy()
    old = fit.lasting.aged(parameters, age_days / DAYS_PER_YEAR)
    kept = [names.index(name) for name in old.names]
    covariance[np.ix_(kept, kept)] = old.covariance
    for i, parameter in enumerate(parameters):
        if parameter.role == "reading_offset":
            covariance[i] = covariance[:, i] = 0.0
            covariance[i, i] = UNKNOWN_OFFSET_MM**2
    return covariance


def with_memory_use(
    result: CalibrationResult, gate: Gate | None, memory: Beforehand | None, age_days: float
) -> CalibrationResult:
    """The result, with the use of the memory."""
    if memory is None or gate is None:
        return result
    if isinstance(memory, FleetPrior):
        text = (
            f"the geometry of {len(memory.serials)} other robots of type {memory.type}"
            if gate.used
            else f"not used: this robot is not like the others of type {memory.type}"
        )
        fleet = FleetUse(used=gate.used, p_value=gate.p_value, text=text, prior=memory)
        return result.model_copy(update={"fleet": fleet})
    use = MemoryUse(**dict(gate_record(gate)), from_calibration=memory.calibration_id, age_days=age_days)
    return result.model_copy(update={"memory": use})
