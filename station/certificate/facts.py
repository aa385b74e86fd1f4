"""The statements of a certificate, as data: taken from the record of one run, whatever its plan."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime
from typing import Literal

from pydantic import JsonValue

from station.certificate.budget import Contribution, reading_budget
from station.errors import NotApplicable
from station.records import (
    Calibration,
    ErrorMap,
    Finding,
    MadeBy,
    Outcome,
    ReasonValue,
    Record,
    ReferenceUse,
    Verdict,
)
from station.run_kinds import application, error_map
from station.settings import JointSettings
from station.store import Store, link_hash

COVERAGE_FACTOR = 2.0
"""k of every expanded uncertainty: about 95 % where the distribution is normal (GUM, 6.2.2 and G.6.6)."""


class ExpandedQuantity(Record):
    """A value with its expanded uncertainty."""

    name: str
    value: float
    u95: float | None
    unit: str


class EffectFound(Record):
    """An effect that the base model lacked."""

    label: str
    """Label in the diagnosis: `backlash of joint 1`."""
    parameters: tuple[ExpandedQuantity, ...]
    probability: float | None
    remedy: str


class PositionErrorStated(Record):
    """Position error over the workspace, mm."""

    before_max_mm: float | None
    """Largest expected error with the previous zeros of the drives."""
    bound_95_mm: float | None
    """With 95 % probability no position error is larger, with the zeros in the drives."""
    wanted_mm: float | None
    fresh_reading_rms_mm: float | None
    fresh_reading_max_mm: float | None


class Statement(Record):
    """The result of the run for the robot."""

    verdict: Verdict | None
    outcome: Outcome | None
    reason: str | None
    reason_code: str | None
    reason_params: dict[str, ReasonValue]


class ZerosInDrives(Record):
    """The state of the zero offsets in the drives when the certificate was issued."""

    state: str
    verified: bool
    run: int | None
    """The last run that wrote or restored zeros."""


class ChainedRecord(Record):
    """The stored record of the run, and its link in the chain of records."""

    fields: dict[str, JsonValue]
    previous: str
    """Hash of the run that ended before it."""
    hash: str
    """SHA-256 of `previous` and the canonical JSON (RFC 8785) of `fields`."""


class CertificateFacts(Record):
    """All numbers are those of the record; an expanded uncertainty is k = 2 times the standard one."""

    schema_name: Literal["station.certificate/1"] = "station.certificate/1"
    number: str
    """The run's UUID."""
    issued_at: datetime
    run: int
    kind: str
    plan: str
    robot_serial: str
    robot_model: str
    operator: str
    work_order: str | None
    began_at: datetime | None
    ended_at: datetime | None
    readings: int
    statement: Statement
    coverage_factor: float = COVERAGE_FACTOR
    zero_offsets: tuple[ExpandedQuantity, ...]
    position_error: PositionErrorStated
    effects: tuple[EffectFound, ...]
    zeros_in_drives: ZerosInDrives | None
    method: str | None
    references: tuple[ReferenceUse, ...]
    reading_budget: tuple[Contribution, ...]
    """Uncertainty budget of one reading of the scale, um."""
    made_by: MadeBy | None
    error_map: ErrorMap | None
    record: ChainedRecord | None
    """Null for a run that ended before the station chained its records."""


def facts_of(
    store: Store, run: int, issued_at: datetime, joints: Sequence[JointSettings]
) -> CertificateFacts:
    """The facts, from the record alone.

    :param joints: range of the commands of each joint, for the map

    :raises NotFound: no such run.
    :raises NotApplicable: it has not ended, or it does not judge a robot.
    """
    calibration = store.calibration(run)
    if not calibration.state.ended:
        raise NotApplicable(f"Run {run} has not ended; its certificate can be made after that.")
    if calibration.verdict is None:
        raise NotApplicable(f"Run {run} has no verdict on a robot, so there is nothing to certify.")
    if store.logs_of(run):
        raise NotApplicable(
            f"Run {run} was made from the log of an arm, measured elsewhere; this station cannot certify it."
        )
    readings = store.readings(run)
    made_by = store.made_by(run)
    chained = _as_it_ended(store, run)
    return CertificateFacts(
        number=calibration.uid,
        issued_at=issued_at,
        run=run,
        kind=calibration.kind,
        plan=calibration.plan,
        robot_serial=calibration.robot_serial,
        robot_model="five-bar",
        operator=calibration.operator,
        work_order=calibration.work_order,
        began_at=calibration.started_at,
        ended_at=calibration.ended_at,
        readings=len(readings),
        statement=Statement(
            verdict=calibration.verdict,
            outcome=calibration.outcome,
            reason=calibration.reason,
            reason_code=calibration.reason_code,
            reason_params=calibration.reason_params,
        ),
        zero_offsets=tuple(
            _expanded(f"joint{zero.joint}", zero.value_deg, zero.sd_deg, "deg")
            for zero in calibration.zero_offsets
            if zero.value_deg is not None
        ),
        position_error=_position_error(calibration),
        effects=tuple(map(_effect, calibration.findings)),
        zeros_in_drives=_zeros_in_drives(store, calibration),
        method=calibration.method,
        references=calibration.references,
        reading_budget=reading_budget(readings, made_by.scale_certificate if made_by else None),
        made_by=made_by,
        error_map=_error_map(store, run, joints),
        record=chained,
    )


def _as_it_ended(store: Store, run: int) -> ChainedRecord | None:
    chained = store.chained(run)
    if chained is None:
        return None
    if link_hash(chained.previous, chained.record) != chained.hash:
        raise NotApplicable(
            f"The record of run {run} is not as it ended: nothing is certified. `station verify` says more."
        )
    return ChainedRecord(fields=chained.record, previous=chained.previous, hash=chained.hash)


def _error_map(store: Store, run: int, joints: Sequence[JointSettings]) -> ErrorMap | None:
    try:
        return error_map(store, run, joints)
    except NotApplicable:
        return None


def _expanded(name: str, value: float, sd: float | None, unit: str) -> ExpandedQuantity:
    u95 = None if sd is None else COVERAGE_FACTOR * sd
    return ExpandedQuantity(name=name, value=value, u95=u95, unit=unit)


def _position_error(calibration: Calibration) -> PositionErrorStated:
    before, after, accuracy = calibration.before, calibration.after, calibration.accuracy
    expected = before.predicted_position_error_mm if before else None
    return PositionErrorStated(
        before_max_mm=expected.max if expected else None,
        bound_95_mm=accuracy.bound_95_mm if accuracy else None,
        wanted_mm=accuracy.wanted_mm if accuracy else None,
        fresh_reading_rms_mm=after.fresh_reading_rms_mm if after else None,
        fresh_reading_max_mm=after.fresh_reading_max_mm if after else None,
    )


def _effect(finding: Finding) -> EffectFound:
    return EffectFound(
        label=finding.label,
        parameters=tuple(_expanded(q.name, q.value, q.sd, q.unit) for q in finding.parameters),
        probability=finding.probability,
        remedy=finding.remedy,
    )


def _zeros_in_drives(store: Store, calibration: Calibration) -> ZerosInDrives | None:
    found = application(store, calibration)
    if found is None:
        return None
    return ZerosInDrives(
        state=found.state, verified=found.verified, run=found.runs[-1].id if found.runs else None
    )
