"""The identified model as JSON, with all that `station solve` needs, and a strict reader."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import ValidationError

from station.diagnosis.learned.acting import Acting
from station.diagnosis.learned.mixture_file import MixtureMachine, mixture_machine
from station.diagnosis.traced_loop import TracedDiagnosis
from station.effects import Acts, Effect, five_bar_catalogue
from station.errors import InputRefused
from station.five_bar import Robot
from station.machines import robot_of
from station.model import Fit, IdentifiedMachine, Situation, Term
from station.records import (
    MIXTURE_SCHEMA,
    MODEL_SCHEMA,
    LearnedRanges,
    MixtureDocument,
    ModelDocument,
    Real,
    Span,
    TemperatureReference,
    TermOfModel,
    content_of,
    said,
    visited_in_degrees,
    visited_ranges,
)

MANY = 100
SCHEMAS: dict[str, type[ModelDocument] | type[MixtureDocument]] = {
    MODEL_SCHEMA: ModelDocument,
    MIXTURE_SCHEMA: MixtureDocument,
}


@dataclass(frozen=True)
class LearnedModel:
    """A model read back."""

    machine: IdentifiedMachine | MixtureMachine
    acting: tuple[Acting, ...]
    joint_range_deg: tuple[Span, ...]
    temperature_c: float | None
    """Reference temperature; None when no temperature change was recorded."""
    confirmed: bool | None
    """Whether it predicted fresh readings; None without fresh readings."""


def model_document(
    diagnosis: TracedDiagnosis, fit: Fit, sd_factor: float, *, stage: str, confirmed: bool | None
) -> ModelDocument:
    """Everything that commands and a transfer need; mm and rad, base parameters, then amplitudes."""
    m = diagnosis.measurements
    degrees = np.degrees(m.theta)
    covariance = (fit.solution.covariance * sd_factor**2).tolist() if len(fit.x) < MANY else None
    return ModelDocument(
        robot=diagnosis.robot.to_json(),
        names=(*fit.model.names, *(t.effect.label for t in fit.model.terms for _ in range(t.size))),
        values=tuple(fit.x.tolist()),
        covariance=covariance,
        terms=tuple(
            TermOfModel(
                effect=term.effect.label,
                on_joint=None if term.acts.joint is None else term.acts.joint + 1,
                on_lengths=None if term.acts.lengths is None else dict(term.acts.lengths),
                on_motion=term.acts.motion,
                hidden=dict(term.hidden),
                amplitudes=tuple(fit.amplitudes(k)[0].tolist()),
            )
            for k, term in enumerate(fit.model.terms)
        ),
        ranges=LearnedRanges(
            joints_deg=tuple(_span(a) for a in degrees.T),
            visited_deg=tuple(tuple(visited_in_degrees(stretches)) for stretches in visited_ranges(m.theta)),
            travel_mm=_span(m.distance) if np.isfinite(m.distance).all() else None,
            time_s=(float(m.t_s.min()), float(m.t_s.max())),
        ),
        reference=TemperatureReference(temperature_c=fit.model.reference.temperature_c),
        stage=stage,
        confirmed=confirmed,
    )


def _span(values: Real) -> Span:
    return float(values.min()), float(values.max())


def read_model(path: Path) -> LearnedModel:
    """The model of a five-bar, from the file of `station diagnose --json`.

    :raises InputRefused: as `read_part`, or the model is of another machine.
    """
    return learned_model(read_part(path), str(path))


def read_part(path: Path) -> ModelDocument | MixtureDocument:
    """The `model` of a diagnosis, for any machine.

    :raises InputRefused: the model is missing, broken, of another schema, or contains an invalid value.
    """
    try:
        content = json.loads(content_of(path, "Model"))
    except (json.JSONDecodeError, UnicodeDecodeError, RecursionError) as error:
        raise InputRefused(f"Model {path} is not valid JSON: {error}.") from error
    return part_of(content, str(path))


def part_of(content: Any, source: str) -> ModelDocument | MixtureDocument:
    """:raises InputRefused: as `read_part`."""
    part = content.get("model") if isinstance(content, dict) else None
    if not isinstance(part, dict):
        raise InputRefused(
            f"Model {source} has no section `model`; give the file of `station diagnose --json`."
        )
    kind = SCHEMAS.get(str(part.get("schema")))
    if kind is None:
        raise InputRefused(
            f"Model {source} is of schema {part.get('schema')!r}; this station reads "
            f"{' and '.join(SCHEMAS)}: diagnose again."
        )
    try:
        return kind.model_validate(part)
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(str(step) for step in first["loc"])
        raise InputRefused(f"Model {source}: [model.{where}] {said(first)}.") from error


def learned_model(part: ModelDocument | MixtureDocument, source: str) -> LearnedModel:
    """A five-bar that can be commanded.  :raises InputRefused: values do not match each other."""
    machine: IdentifiedMachine | MixtureMachine
    if isinstance(part, MixtureDocument):
        machine, acting = mixture_machine(part, source)
    else:
        machine, acting = _single(part, source)
    return LearnedModel(machine, acting, part.ranges.joints_deg, part.reference.temperature_c, part.confirmed)


def _single(part: ModelDocument, source: str) -> tuple[IdentifiedMachine, tuple[Acting, ...]]:
    """One model with its effects."""
    robot = robot_of(part.robot, source=f"{source}: [model.robot]")
    if not isinstance(robot, Robot):
        raise InputRefused(
            f"Model {source} is of a serial arm, whose commands its own controller computes; "
            "only a five-bar's are solved here. `station transfer` applies the model to other readings."
        )
    terms = terms_of(part, five_bar_catalogue(), source)
    size = len(part.values)
    amplitudes = [a for term in part.terms for a in term.amplitudes]
    rows = part.covariance or ()
    covariance = np.array(rows) if {len(row) for row in rows} == {size} else np.empty(0)
    if covariance.shape != (size, size) or len(part.names) != size:
        raise InputRefused(
            f"Model {source}: [model.covariance] must be square, with one row and one column per value."
        )
    if size < len(amplitudes) + 13 or list(part.values[size - len(amplitudes) :]) != amplitudes:
        raise InputRefused(f"Model {source}: [model.values] must end with the amplitudes of the terms.")
    machine = IdentifiedMachine(robot, np.array(part.values), covariance, terms, part.ranges.time_s[1])
    centre = np.array([complex(np.mean(robot.workspace_x), np.mean(robot.workspace_y))])
    try:
        machine.commands(centre, Situation.plain(1))
    except (ValueError, KeyError, IndexError, ArithmeticError) as error:
        raise InputRefused(f"Model {source}: it cannot be evaluated ({error}).") from error
    return machine, tuple(_acting(term) for term in terms)


def _acting(term: Term) -> Acting:
    i = term.acts.joint
    return Acting(
        term.effect.label,
        joints=() if i is None else (i + 1,),
        by_approach=(term.effect.joint or 1,) if term.effect.by_approach else (),
        by_payload="by_payload" in term.hidden,
    )


def terms_of(part: ModelDocument, effects: Sequence[Effect], source: str) -> tuple[Term, ...]:
    """The effects of a model, looked up in a catalogue. :raises InputRefused: one is not in it."""
    return tuple(_term(term, effects, source) for term in part.terms)


def _term(part: TermOfModel, effects: Sequence[Effect], source: str) -> Term:
    effect = next((e for e in effects if e.label == part.effect), None)
    if effect is None:
        raise InputRefused(f"Model {source}: [model.terms] effect {part.effect!r} is not in the catalogue.")
    acts = Acts(None if part.on_joint is None else part.on_joint - 1, part.on_lengths, part.on_motion)
    return Term(effect, part.hidden, acts, len(part.amplitudes))
