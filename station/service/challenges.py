"""Errors that the training desk can introduce on the emulated machine, with sizes that a run can detect.

The sizes are for the emulated machine, which runs faster than real time: a drift is large per hour because a
run takes a minute.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from pydantic import JsonValue

from station.motion import EffectTable, FaultOrder
from station.records import Challenge, ChallengeGroup


@dataclass(frozen=True, slots=True)
class Kind:
    """One kind of error, and how it is ordered."""

    kind: str
    group: ChallengeGroup
    key: str = ""
    """The field that contains the size."""
    unit: str = ""
    sizes: tuple[float, float, float] | None = None
    """Smallest, default and largest size."""
    joint: bool = False
    more: dict[str, JsonValue] = field(default_factory=dict)
    """Fields with constant values."""

    def shown(self) -> Challenge:
        """The kind as the page receives it."""
        smallest, usual, largest = self.sizes or (None, None, None)
        return Challenge(
            kind=self.kind,
            group=self.group,
            joint=self.joint,
            unit=self.unit,
            smallest=smallest,
            usual=usual,
            largest=largest,
        )

    def effects(self, joint: int | None, size: float | None) -> list[EffectTable]:
        """The effects to order for the machine."""
        if self.group == "fault":
            return []
        table: EffectTable = {"kind": self.kind, **self.more}
        if self.key:
            table[self.key] = size
        if self.joint:
            table["joint"] = joint
        return [table]

    def faults(self, joint: int | None) -> list[FaultOrder]:
        """The faults to order for the devices."""
        if self.group != "fault":
            return []
        device, _, kind = self.kind.partition(" ")
        named = f"axis{joint}" if self.joint else device
        return [FaultOrder.model_validate({"device": named, "kind": kind})]


def _known(kind: str, key: str, unit: str, *sizes: float, joint: bool = False, **more: JsonValue) -> Kind:
    return Kind(kind, "catalogue", key, unit, (sizes[0], sizes[1], sizes[2]), joint, more)


def _unnamed(kind: str, key: str, unit: str, *sizes: float, joint: bool = False, **more: JsonValue) -> Kind:
    return Kind(kind, "unnamed", key, unit, (sizes[0], sizes[1], sizes[2]), joint, more)


KINDS: dict[str, Kind] = {
    kind.kind: kind
    for kind in (
        _known("backlash", "width_deg", "deg", 0.01, 0.05, 0.1, joint=True),
        _known("gear_cyclic", "amplitude_deg", "deg", 0.004, 0.01, 0.03, joint=True, per_rev=20.0),
        _known("encoder_eccentricity", "amplitude_deg", "deg", 0.04, 0.08, 0.2, joint=True, phase_deg=40.0),
        _known("transmission_gain", "ppm", "ppm", 1000, 2500, 6000, joint=True),
        _known("compliance", "deg_at_horizontal", "deg", 0.03, 0.08, 0.2, joint=True),
        _known("count_slip", "step_deg", "deg", 0.01, 0.03, 0.1, joint=True, from_stop=60),
        _known("link_length", "mm", "mm", 0.3, 0.8, 2.0, joint=True, link="L"),
        _known("scale_gain", "ppm", "ppm", 1000, 3000, 8000),
        _known("scale_bow", "mm_at_end", "mm", 0.03, 0.08, 0.2),
        _known("scale_cyclic", "amplitude_mm", "mm", 0.006, 0.015, 0.05, period_mm=4.0),
        _known("scale_hysteresis", "width_mm", "mm", 0.015, 0.04, 0.1),
        _known("drift", "mm_per_hour", "mm/h", 2, 6, 20),
        _known("reading_step", "step_mm", "mm", 0.015, 0.04, 0.2, from_stop=60),
        _unnamed("base_flex", "sideways_mm", "mm", 0.1, 0.3, 1.0, roll_deg=0.0),
        _unnamed("bearing_runout", "amplitude_mm", "mm", 0.03, 0.08, 0.2, joint=True),
        _unnamed("encoder_ellipse", "amplitude_deg", "deg", 0.004, 0.01, 0.03, joint=True),
        _unnamed("cable_torque", "deg_at_end", "deg", 0.01, 0.03, 0.1, joint=True),
        _unnamed("worn_sector", "deg", "deg", 0.006, 0.02, 0.06, joint=True, at_deg=0.0),
        _unnamed("guide_sag", "mm_at_corner", "mm", 0.02, 0.05, 0.15),
        _unnamed("loose_elbow", "mm", "mm", 0.015, 0.04, 0.1, joint=True),
        _unnamed("magnetised_spot", "peak_mm", "mm", 0.02, 0.05, 0.2, rho_mm=580.0),
        _unnamed("room_cycle", "amplitude_mm", "mm", 0.01, 0.025, 0.08, period_s=40.0),
        _unnamed("speed_stiction", "deg", "deg", 0.005, 0.015, 0.05, joint=True),
        Kind("scale silent", "fault"),
        Kind("scale contaminated", "fault"),
        Kind("scale frozen", "fault"),
        Kind("axis never_in_position", "fault", joint=True),
        Kind("axis following_error", "fault", joint=True),
        Kind("axis frozen", "fault", joint=True),
        Kind("line bad_crc", "fault"),
        Kind("line port_gone", "fault"),
    )
}
"""Kinds by name; the name of a fault is its device and its kind."""
