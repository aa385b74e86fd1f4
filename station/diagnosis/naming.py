"""The name of an error of the five-bar, its explanation, remedy, and how to distinguish it from others."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

from station.effects import Effect, five_bar_catalogue
from station.records import EffectName, Phrase, phrase

PartKey = tuple[str, int | None, str | None]

ENTRY = {
    "transmission_gain": phrase("check_ratio"),
    "link_length": phrase("check_length"),
    "scale_gain": phrase("check_scale_factor"),
}
"""A wrong entry of the same size as a real defect."""


@dataclass(frozen=True)
class Naming:
    """The texts about one effect."""

    label: str
    physics: Phrase
    remedy: Phrase
    experiment: Phrase


MOUNTING = Naming(
    "thermal_growth of the mounting",
    phrase("mounting_growth_physics"),
    phrase("mounting_growth_remedy"),
    phrase("mounting_growth_experiment"),
)
READING_STEP = Naming(
    "reading_step",
    phrase("reading_step_physics"),
    phrase("reading_step_remedy"),
    phrase("reading_step_experiment"),
)
DEPENDENCES = {
    "joint1": "of joint 1",
    "joint2": "of joint 2",
    "reading": "of the reading",
    "place": "by place",
    "time": "over time",
    "approach": "by approach",
}


def named(key: PartKey, depends_on: str | None = None) -> Naming:
    """Texts of an effect of the engine; an unnamed error is described by what it depends on."""
    effect, joint, part = key
    if effect == "unnamed":
        label = f"unnamed error {DEPENDENCES[depends_on or 'reading']}"
        texts = phrase("unnamed_physics"), phrase("unnamed_remedy"), phrase("unnamed_experiment")
        return Naming(label, *texts)
    if effect == "reading_step":
        return READING_STEP
    if part == "mounting":
        return MOUNTING
    by_label = _catalogue()
    if effect == "link_length":
        return by_label[f"{effect} {part}"]
    if part == "links":
        return by_label[f"{effect} of the links"]
    return by_label[effect if joint is None else f"{effect} of joint {joint}"]


def name_record(key: PartKey) -> EffectName:
    """The name as documents contain it."""
    effect, joint, _ = key
    return EffectName(effect=effect, joint=joint, part=part_of(key))


def part_of(key: PartKey) -> str | None:
    """The part on which an effect acts."""
    effect, joint, part = key
    if part is not None:
        return part
    if joint is not None:
        return f"joint{joint}"
    return "scale" if effect.startswith("scale_") else None


@cache
def _catalogue() -> dict[str, Naming]:
    return {e.label: Naming(e.label, e.physics, _remedy(e), e.experiment) for e in five_bar_catalogue()}


def _remedy(effect: Effect) -> Phrase:
    entry = ENTRY.get(effect.id)
    return effect.remedy if entry is None else phrase("sentences", first=effect.remedy, second=entry)
