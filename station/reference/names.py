"""The identifiers in documents, REST and the database, with their names and explanations."""

from __future__ import annotations

from collections.abc import Iterable
from typing import get_args

from station.effects import arm_catalogue, five_bar_catalogue
from station.messages import Group, display_name, explanation, reasons
from station.plans import PLANS
from station.records import DiagnosisVerdict, Outcome, State, Verdict
from station.reference.markdown import code, page, section, table
from station.run_kinds import RUN_KINDS


def names_page() -> str:
    """Plans, kinds of run, states, verdicts, outcomes, effects, reasons."""
    return page(
        "Names",
        "The identifiers in documents, REST and the database, with their display names.",
        section(
            "Plans", _named("plans", PLANS, ("measured by", {p.name: p.run_kind for p in PLANS.values()}))
        ),
        section("Kinds of run", _named("run_kinds", RUN_KINDS)),
        section("States", _named("states", State)),
        section("Verdicts of a run", _named("verdicts", get_args(Verdict))),
        section("Verdicts of a diagnosis", _named("verdicts", get_args(DiagnosisVerdict))),
        section("Outcomes", _named("outcomes", get_args(Outcome))),
        section("Effects", _effects()),
        section(
            "Reasons",
            "",
            "`reason_code`, and the sentence into which `reason_params` are inserted.",
            table(("code", "sentence"), ((code(c), code(text)) for c, text in reasons().items())),
        ),
    )


def _named(group: Group, ids: Iterable[str], more: tuple[str, dict[str, str]] | None = None) -> str:
    header = ("id", "name", "meaning", *((more[0],) if more else ()))
    return table(
        header,
        (
            (
                code(str(id)),
                display_name(group, id),
                explanation(group, id),
                *((code(more[1][id]),) if more else ()),
            )
            for id in ids
        ),
    )


def _effects() -> str:
    effects = {
        effect.id: effect
        for effect in (*five_bar_catalogue(), *arm_catalogue(6, by_range=True, timed=True, warmed=True))
    }
    return table(
        ("id", "name", "meaning", "remedy", "experiment that distinguishes it"),
        (
            (
                code(id),
                display_name("effects", id),
                explanation("effects", id),
                effect.remedy.text(),
                effect.experiment.text(),
            )
            for id, effect in effects.items()
        ),
    )
