"""An identification as its document."""

from __future__ import annotations

import numpy as np

from station.five_bar import FiveBar
from station.identification.estimate import Gate, Identification
from station.identification.jump import find_jump
from station.machines import AnyMechanism
from station.records import (
    Convergence,
    DataSource,
    GateOfMemory,
    IdentificationDocument,
    JumpNote,
    PositionErrorAt,
    PredictedAccuracy,
    ResidualSummary,
    ZeroOffset,
    phrase,
)


def identification_document(
    found: Identification[AnyMechanism], data: DataSource | None = None
) -> IdentificationDocument:
    """Everything that one fit says; `data` tells what it was made from."""
    errors, quantities = found.errors_mm, found.quantities()
    joints = len(found.dtheta)
    has_workspace = bool(len(found.mechanism.workspace))
    jump = jump_of(found)
    return IdentificationDocument(
        data=data,
        noise=found.noise.record(),
        zero_offsets=tuple(
            ZeroOffset(joint=i + 1, value_deg=q.value, sd_deg=q.sd) for i, q in enumerate(quantities[:joints])
        ),
        modes=found.modes() if has_workspace else (),
        parameters=quantities,
        coverage_factor=found.noise.coverage_factor,
        weak_direction=found.weak_direction,
        singular_values=tuple(found.solution.singular_values.tolist()),
        residual=ResidualSummary(
            rms_mm=float(np.sqrt(np.mean(errors**2))),
            max_mm=float(errors.max()),
            lack_of_fit_p=found.lack_of_fit_p,
            adequate=found.adequate and jump is None,
        ),
        sd_factor=found.sd_factor,
        before=PredictedAccuracy(predicted_position_error_mm=found.position_error(False)),
        after=PredictedAccuracy(predicted_position_error_mm=found.position_error(True)),
        position_error_map=position_error_map(found),
        outliers=tuple(o.record() for o in found.outliers),
        jump=jump,
        references=found.references,
        memory=None if found.gate is None else gate_record(found.gate),
        convergence=Convergence(
            steps=found.solution.steps,
            status=found.solution.status,
            message=found.solution.message,
            gain_left=found.solution.gain_left,
        ),
    )


def jump_of(found: Identification[AnyMechanism]) -> JumpNote | None:
    """What jumped between readings of a five-bar that are in the order in which they were taken."""
    mechanism = found.mechanism
    if not isinstance(mechanism, FiveBar) or np.any(np.diff(found.measurements.t_s) < 0.0):
        return None
    jump = find_jump(mechanism)
    return None if jump is None else jump.note(found.measurements.ids[jump.index])


def position_error_map(found: Identification[AnyMechanism]) -> tuple[PositionErrorAt, ...]:
    """Predicted position error at each of the workspace's positions, before and after compensation."""
    before, after = (found.position_error_field(compensated) for compensated in (False, True))
    if before is None or after is None:
        return ()
    return tuple(
        PositionErrorAt(x_mm=float(r.real), y_mm=float(r.imag), before_mm=float(b), after_mm=float(a))
        for r, b, a in zip(found.mechanism.workspace, before, after, strict=True)
    )


def gate_record(gate: Gate) -> GateOfMemory:
    """In words."""
    said = phrase("memory_used") if gate.used else phrase("memory_contradicted")
    return GateOfMemory(used=gate.used, p_value=gate.p_value, text=said.text(), said=said)
