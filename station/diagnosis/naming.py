"""The name of an error of the five-bar, its explanation, remedy, and how to distinguish it from others."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

from station.effects import five_bar_catalogue
from station.messages import explanation
from station.records import EffectName

PartKey = tuple[str, int | None, str | None]

ENTRY = {
    "transmission_gain": " The same is seen where `[joints] ratio` or `counts_per_rev` is wrong: check both.",
    "link_length": " The same is seen where the robot file has a wrong length: compare it with the drawing.",
    "scale_gain": " The same is seen where the readout has a wrong factor: check its setting.",
}
"""A wrong entry of the same size as a real defect."""


@dataclass(frozen=True)
class Naming:
    """The texts about one effect."""

    label: str
    physics: str
    remedy: str
    experiment: str


MOUNTING = Naming(
    "thermal_growth of the mounting",
    "The mounting of scale or mechanism moves when it becomes warm.",
    "Let the machine warm up before it is measured; check the mounting of scale and mechanism.",
    "Repeat the measurement sequence warm, with the temperature recorded.",
)
READING_STEP = Naming(
    "reading_step",
    "The readout or its mounting jumped: all readings from one on are off by the same amount.",
    "Check the mounting of head and scale and the readout's supply, then measure again.",
    "Read the first positions again: the step stays, at every position alike.",
)
DEPENDENCES = {
    "joint1": "of joint 1",
    "joint2": "of joint 2",
    "reading": "of the reading",
    "place": "by place",
    "time": "over time",
    "approach": "by approach",
}
UNNAMED_REMEDY = "No entry of the catalogue has this shape; look at the residual, and at what moves with it."
UNNAMED_EXPERIMENT = "Measure again with something changed: the payload, the mounting point, the speed."


def named(key: PartKey, depends_on: str | None = None) -> Naming:
    """Texts of an effect of the engine; an unnamed error is described by what it depends on."""
    effect, joint, part = key
    if effect == "unnamed":
        label = f"unnamed error {DEPENDENCES[depends_on or 'reading']}"
        return Naming(label, explanation("effects", "unnamed"), UNNAMED_REMEDY, UNNAMED_EXPERIMENT)
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
    return {
        e.label: Naming(e.label, e.physics, e.remedy + ENTRY.get(e.id, ""), e.experiment)
        for e in five_bar_catalogue()
    }
