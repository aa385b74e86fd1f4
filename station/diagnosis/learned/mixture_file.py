"""A set of explanations as JSON (schema station.model/2), with all that commands need, and its reader."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass

import numpy as np

from station.diagnosis.explanations import (
    Around,
    Choice,
    Family,
    KeptError,
    KeptExplanation,
    Mixture,
    NotInCatalogue,
    restored,
)
from station.diagnosis.explanations import Situation as Layout
from station.diagnosis.learned.acting import Acting
from station.diagnosis.naming import named
from station.diagnosis.weighed_loop import WeighedDiagnosis
from station.errors import InputRefused
from station.five_bar import FiveBar, Robot
from station.machines import robot_of
from station.mechanism import Reference
from station.model import NotInvertible, Situation
from station.records import (
    Complex,
    ErrorOfModel,
    ExplanationOfModel,
    LearnedRanges,
    LearnedReadings,
    Measurements,
    MixtureDocument,
    Real,
    ReferenceOfReadings,
    phrase,
    visited_in_degrees,
    visited_ranges,
)

ON_JOINTS = {"joint1": 1, "joint2": 2}
MOVES_NOTHING = "reading"
BY_PAYLOAD = ("compliance", "uneven compliance")
WORTH_A_LIMIT = 0.05
"""Probability from which the joints' range limits commands."""
LIKELY = 0.5
"""Probability from which the inputs of an error (a side of approach) are required."""


def mixture_document(diagnosis: WeighedDiagnosis, *, stage: str) -> MixtureDocument:
    """Everything that commands under the set need; mm and rad."""
    found = diagnosis.found
    m, mixture, weighing = found.weighing.mechanism.measurements, found.mixture, found.weighing
    sequence = diagnosis.measurements
    low, high = sequence.theta.min(axis=0), sequence.theta.max(axis=0)
    return MixtureDocument(
        robot=diagnosis.robot.to_json(),
        names=tuple(p.name for p in found.mechanism.parameters),
        values=tuple(mixture.mean.tolist()),
        covariance=tuple(map(tuple, mixture.covariance.tolist())),
        explanations=tuple(
            ExplanationOfModel(
                probability=float(weight),
                values=tuple(one.x[: one.size].tolist()),
                errors=tuple(
                    _error(family, choice, amplitudes, mixture.situation)
                    for family, choice, amplitudes in zip(
                        one.families, one.choices, one.amplitudes, strict=True
                    )
                ),
            )
            for one, weight in zip(mixture.settled, mixture.weight, strict=True)
        ),
        start=tuple(weighing.start.tolist()),
        readings=_readings(m),
        ranges=LearnedRanges(
            joints_deg=tuple(
                (float(a), float(b)) for a, b in zip(np.degrees(low), np.degrees(high), strict=True)
            ),
            visited_deg=tuple(tuple(visited_in_degrees(v)) for v in visited_ranges(sequence.theta)),
            travel_mm=(float(sequence.distance.min()), float(sequence.distance.max())),
            time_s=(float(sequence.t_s.min()), float(sequence.t_s.max())),
        ),
        reference=ReferenceOfReadings(
            temperature_c=weighing.reference.temperature_c,
            theta_rad=(float(weighing.reference.theta[0]), float(weighing.reference.theta[1])),
            travel_mm=weighing.reference.travel,
        ),
        stage=stage,
        confirmed=diagnosis.confirmed,
    )


def _error(family: Family, choice: Choice, amplitudes: Real, situation: Layout) -> ErrorOfModel:
    targets = set(family.targets(situation))
    moving = targets - {MOVES_NOTHING}
    joints = tuple(sorted(ON_JOINTS[t] for t in moving if t in ON_JOINTS))
    by_approach: tuple[int, ...] = ()
    if moving and ("backlash" in {p.effect for p in family.parts} or family.depends_on == "approach"):
        by_approach = joints or (1, 2)
    return ErrorOfModel(
        family=choice.family,
        kind=family.kind,
        labels=tuple(named(part.key, family.depends_on).label for part in family.parts),
        # the shape of an unnamed error is known only where it was measured
        joints=(1, 2) if moving and not family.named else joints,
        by_approach=by_approach,
        hidden={name: float(value) for name, value in family.hidden[choice.member].items()},
        amplitudes=tuple(amplitudes.tolist()),
    )


def _readings(m: Measurements) -> LearnedReadings:
    came_from = np.asarray(m.came_from)
    return LearnedReadings(
        t_s=tuple(m.t_s.tolist()),
        theta_rad=tuple((a, b) for a, b in m.theta.tolist()),
        approach=tuple((a, b) for a, b in m.approach.tolist()),
        distance_mm=tuple(m.distance.tolist()),
        came_from=tuple(
            (None, None, None) if np.isnan(row).any() else (float(row[0]), float(row[1]), float(row[2]))
            for row in came_from
        ),
        mount=tuple(m.mount.tolist()),
        mounts=m.mounts,
        temperature_c=None if m.temperature_c is None else tuple(m.temperature_c.tolist()),
        payload_kg=None if m.payload_kg is None else tuple(m.payload_kg.tolist()),
    )


@dataclass(frozen=True)
class MixtureMachine:
    """The machine as described by a set of explanations."""

    robot: Robot
    mixture: Mixture

    def commands(self, place: Complex, situation: Situation) -> Real:
        """(K, 2) joint commands, rad, best on average over the set.

        :raises Unreachable: a position is out of reach. :raises NotInvertible: no command was found.
        """
        theta = self.mixture.commands(place, _around(situation))
        if not np.isfinite(theta).all():
            raise NotInvertible(phrase("no_finite_command"))
        return theta

    def positions(self, theta: Real, situation: Situation) -> Complex:
        """(K,) position of P on average over the set, mm."""
        return self.mixture.positions(theta, _around(situation))


def _around(situation: Situation) -> Around:
    return Around(situation.approach, situation.temperature_rise, situation.payload_kg)


def mixture_machine(part: MixtureDocument, source: str) -> tuple[MixtureMachine, tuple[Acting, ...]]:
    """A five-bar that can be commanded.  :raises InputRefused: values do not match each other."""
    robot = robot_of(part.robot, source=f"{source}: [model.robot]")
    if not isinstance(robot, Robot):
        raise InputRefused(f"Model {source}: [model.robot] is not a five-bar.")
    mechanism = FiveBar(robot, _measurements(part.readings, source))
    size = len(mechanism.parameters)
    if len(part.covariance) != size or any(len(row) != size for row in part.covariance):
        raise InputRefused(
            f"Model {source}: [model.covariance] must be square, with one row and one column per value."
        )
    sizes = {len(part.start), len(part.values), *(len(one.values) for one in part.explanations)}
    if sizes != {size} or len(part.names) != size:
        raise InputRefused(f"Model {source}: [model.values] must have {size} values, one for each name.")
    reference = Reference(
        part.reference.temperature_c, np.array(part.reference.theta_rad), part.reference.travel_mm
    )
    kept = [
        KeptExplanation(
            one.probability,
            np.array(one.values),
            tuple(KeptError(e.family, e.kind, e.hidden, np.array(e.amplitudes)) for e in one.errors),
        )
        for one in part.explanations
    ]
    try:
        mixture = restored(mechanism, np.array(part.start), reference, kept)
        machine = MixtureMachine(robot, mixture)
        centre = np.array([complex(np.mean(robot.workspace_x), np.mean(robot.workspace_y))])
        machine.commands(centre, Situation.plain(1))
    except NotInCatalogue as error:
        raise InputRefused(
            f"Model {source}: [model.explanations] error {error} is not in the catalogue of this version: "
            "diagnose again."
        ) from error
    except (ValueError, KeyError, IndexError, ArithmeticError) as error:
        raise InputRefused(f"Model {source}: it cannot be evaluated ({error}).") from error
    return machine, _acting(part, payload=mixture.situation.payload_kg is not None)


def _acting(part: MixtureDocument, *, payload: bool) -> tuple[Acting, ...]:
    """Effects that are probable enough to be relevant."""
    share: dict[str, float] = defaultdict(float)
    errors: dict[str, ErrorOfModel] = {}
    for one in part.explanations:
        for error in one.errors:
            for label in error.labels:
                share[label] += one.probability
                errors.setdefault(label, error)
    total = sum(one.probability for one in part.explanations)
    out = []
    for label, error in errors.items():
        p = share[label] / total
        if p >= WORTH_A_LIMIT:
            likely = p >= LIKELY
            by_payload = likely and payload and error.kind in BY_PAYLOAD
            out.append(Acting(label, error.joints, error.by_approach if likely else (), by_payload))
    return tuple(out)


def _measurements(r: LearnedReadings, source: str) -> Measurements:
    count = len(r.t_s)
    columns = (r.theta_rad, r.approach, r.distance_mm, r.came_from, r.mount)
    optional = [c for c in (r.temperature_c, r.payload_kg) if c is not None]
    if {len(c) for c in (*columns, *optional)} != {count} or not count or max(r.mount) >= len(r.mounts):
        raise InputRefused(f"Model {source}: [model.readings] must have all columns of one length.")
    nothing = (np.nan, np.nan, np.nan)
    return Measurements(
        ids=tuple(range(count)),
        t_s=np.array(r.t_s),
        theta=np.array(r.theta_rad),
        approach=np.array(r.approach, dtype=np.int8),
        distance=np.array(r.distance_mm),
        position=np.arange(count),
        mount=np.array(r.mount, dtype=np.intp),
        samples=np.ones(count, dtype=np.intp),
        mounts=r.mounts,
        temperature_c=None if r.temperature_c is None else np.array(r.temperature_c),
        payload_kg=None if r.payload_kg is None else np.array(r.payload_kg),
        came_from=np.array([nothing if None in row else row for row in r.came_from], dtype=float),
    )
