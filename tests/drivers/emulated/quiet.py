"""Emulated machines without noise, read in virtual time."""

from __future__ import annotations

from drivers.emulated.imperfections import AnyEffect
from drivers.emulated.spec import MachineSpec
from drivers.emulated.virtual import VirtualReading, VirtualRig


def quiet(*present: AnyEffect, **given: object) -> MachineSpec:
    """A machine without noise and with the given effects."""
    return MachineSpec.model_validate(
        {"scatter": False, "scale_noise_mm": 0.0, "head_zero_mm": 0.0, "effects": present, **given}
    )


def read(spec: MachineSpec, *stops_deg: tuple[float, float]) -> list[VirtualReading]:
    return VirtualRig(spec).measure(stops_deg)


def change_mm(effect: AnyEffect, *stops_deg: tuple[float, float], **given: object) -> list[float]:
    """Contribution of an effect to the readings of a sequence."""
    with_it, without = read(quiet(effect, **given), *stops_deg), read(quiet(**given), *stops_deg)
    return [a.scale_mm - b.scale_mm for a, b in zip(with_it, without, strict=True)]
