"""All families that compete for one set of readings."""

from __future__ import annotations

from collections.abc import Mapping

from station.diagnosis.explanations.coupled_families import coupled_families
from station.diagnosis.explanations.family import Family
from station.diagnosis.explanations.motion_families import motion_families
from station.diagnosis.explanations.rough_families import rough_families
from station.diagnosis.explanations.situation import Situation
from station.diagnosis.explanations.smooth_families import smooth_families
from station.diagnosis.explanations.smooth_processes import processes
from station.diagnosis.explanations.structured_families import structured_families


def catalogue(s: Situation, lengths: Mapping[str, float], *, thermometer: bool) -> tuple[Family, ...]:
    """Families for the readings of `s`, nominal lengths by name (mm), and whether it has temperatures."""
    return (
        *rough_families(s, lengths, thermometer=thermometer),
        *smooth_families(s),
        *structured_families(),
        *coupled_families(s),
        *motion_families(s),
        *processes(s),
    )
