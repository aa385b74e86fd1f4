"""The kinds of machine of the study: what is in the catalogue, and what has no name in it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

Table = dict[str, Any]
Cause = tuple[str, int | None]
"""An effect of the catalogue and its joint."""
Make = Callable[[float], list[Table]]
"""Amplitude (1 is a usual size) -> errors as tables of a rig file."""

CATALOGUE = (
    "backlash", "gear_cyclic", "encoder_eccentricity", "transmission_gain", "compliance", "count_slip",
    "link_length", "distal_link", "scale_gain", "scale_bow", "scale_cyclic", "scale_hysteresis", "drift",
    "thermal_links", "thermal_scale",
)  # fmt: skip
STEPS = ("reading_step", "healing_step")
NATURAL = ("both_compliance", "both_transmission_gain", "both_encoder_eccentricity", "both_L", "both_l")
"""The same error on both sides."""
UNEVEN = "stiffening_sag"
"""A sag of both joints that is not in proportion to the load."""
SEVERAL = (
    ("backlash", "gear_cyclic"), ("drift", "scale_cyclic"), ("gear_cyclic", "gear_cyclic"),
    ("backlash", "drift"), ("count_slip", "scale_hysteresis"), ("backlash", "gear_cyclic", "drift"),
    ("count_slip", "scale_cyclic", "backlash"),
)  # fmt: skip
SMOOTH = {
    "base_flex": "place",
    "platform_tilt": "place",
    "platform_yaw": "place",
    "link_bend": "place",
    "bearing_runout": "joint",
    "encoder_ellipse": "joint",
    "cable_torque": "joint",
    "cable_windup": "joint",
    "axis_tilt": "joint",
    "belt_stretch": "joint",
    "arm_coupling": "joint",
    "worn_sector": "joint",
    "guide_sag": "travel",
}
ROUGH = {
    "cable_drag": "approach x place",
    "slider_drag": "approach x place",
    "sticky_patch": "approach x place",
    "stiction_patch": "place",
    "field_bump": "travel",
    "magnetised_spot": "travel",
    "random_walk": "time",
    "wandering_zero": "time",
    "mounting_creep": "time",
    "room_cycle": "time",
    "base_gradient": "time",
    "sinking_bearing": "time",
    "slipping_link": "time",
    "loose_head": "time",
    "readout_lag": "approach",
    "rest_by_distance": "approach",
    "speed_stiction": "approach",
    "reversal_slip": "approach",
    "loose_elbow": "approach",
}
OUTSIDE = {**SMOOTH, **ROUGH}
"""Nothing of the catalogue, and on what it depends."""
GROUPS: dict[str, tuple[tuple[str, ...], ...]] = {
    "clean": ((),),
    "one cause": tuple((k,) for k in CATALOGUE),
    "natural pair": tuple((k,) for k in (*NATURAL, UNEVEN)),
    "several causes": SEVERAL,
    "step of the reading": tuple((k,) for k in STEPS),
    "smooth, without a name": tuple((k,) for k in SMOOTH),
    "rough, without a name": tuple((k,) for k in ROUGH),
}
KINDS = tuple(kind for kinds in GROUPS.values() for kind in kinds)
BOTH = (1, 2)
ALIKE = {"thermal_links": "thermal_growth", "thermal_scale": "thermal_growth", "distal_link": "link_length"}
ALIKE |= {"both_L": "link_length", "both_l": "link_length", "healing_step": "reading_step"}
"""What a kind is called in the catalogue, where it has a name of its own here."""


def causes(kind: str, tables: Sequence[Table]) -> set[Cause]:
    """What the catalogue has of a kind."""
    if kind in OUTSIDE:
        return set()
    if kind == UNEVEN:
        return {("compliance", joint) for joint in BOTH}
    name = ALIKE.get(kind, kind.removeprefix("both_"))
    return {(name, table.get("joint")) for table in tables}


def errors(kind: str, rng: np.random.Generator) -> Make:
    """Everything random but the amplitude is drawn here."""
    joint, sign = int(rng.integers(1, 3)), float(rng.choice([-1.0, 1.0]))
    phase = float(rng.uniform(0.0, 360.0))
    if kind in OUTSIDE or kind == UNEVEN:
        return _without_a_name(kind, rng, joint, sign, phase)
    if kind in NATURAL:
        return _on_both(kind, sign, (phase, float(rng.uniform(0.0, 360.0))))
    one = _of_the_catalogue(kind, rng, joint, sign, phase)
    return lambda a: [one(a)]


def _on_both(kind: str, sign: float, phases: tuple[float, float]) -> Make:
    if kind in ("both_L", "both_l"):
        mm = 1.0 if kind == "both_L" else 2.0
        return lambda a: [
            {"kind": "link_length", "joint": i, "link": kind[-1], "mm": mm * sign * a} for i in BOTH
        ]
    name = kind.removeprefix("both_")
    key, usual = {
        "compliance": ("deg_at_horizontal", 0.05),
        "transmission_gain": ("ppm", 3000.0 * sign),
        "encoder_eccentricity": ("amplitude_deg", 0.05),
    }[name]
    more = [{"phase_deg": p} if name == "encoder_eccentricity" else {} for p in phases]
    return lambda a: [{"kind": name, "joint": i, key: usual * a, **more[i - 1]} for i in BOTH]


def _of_the_catalogue(
    kind: str, rng: np.random.Generator, joint: int, sign: float, phase: float
) -> Callable[[float], Table]:
    tau = float(rng.uniform(40.0, 200.0))
    match kind:
        case "backlash":
            return lambda a: {"kind": kind, "joint": joint, "width_deg": 0.01 * abs(a)}
        case "gear_cyclic":
            n = float(rng.choice([8, 10, 12, 17, 20, 25, 30, 40, 60]))
            return lambda a: {
                "kind": kind, "joint": joint, "amplitude_deg": 0.004 * a, "per_rev": n, "phase_deg": phase,
            }  # fmt: skip
        case "encoder_eccentricity":
            return lambda a: {"kind": kind, "joint": joint, "amplitude_deg": 0.05 * a, "phase_deg": phase}
        case "transmission_gain":
            return lambda a: {"kind": kind, "joint": joint, "ppm": 1000.0 * sign * a}
        case "compliance":
            return lambda a: {"kind": kind, "joint": joint, "deg_at_horizontal": 0.05 * a}
        case "count_slip":
            stop = int(rng.integers(12, 110))
            return lambda a: {"kind": kind, "joint": joint, "step_deg": 0.01 * sign * a, "from_stop": stop}
        case "link_length":
            return lambda a: {"kind": kind, "joint": joint, "link": "L", "mm": 0.3 * sign * a}
        case "distal_link":
            return lambda a: {"kind": "link_length", "joint": joint, "link": "l", "mm": 2.0 * sign * a}
        case "reading_step":
            stop = int(rng.integers(12, 110))
            return lambda a: {"kind": kind, "step_mm": 0.02 * sign * a, "from_stop": stop}
        case "healing_step":
            stop, length = int(rng.integers(12, 70)), int(rng.integers(20, 45))
            return lambda a: {
                "kind": kind, "step_mm": 0.02 * sign * a, "from_stop": stop, "for_stops": length,
            }  # fmt: skip
        case "scale_gain":
            return lambda a: {"kind": kind, "ppm": 3000.0 * sign * a}
        case "scale_bow":
            return lambda a: {"kind": kind, "mm_at_end": 0.05 * sign * a}
        case "scale_cyclic":
            period = float(rng.choice([0.5, 1.0, 2.0, 4.0, 5.0, 10.0, 20.0]))
            return lambda a: {
                "kind": kind, "amplitude_mm": 0.01 * a, "period_mm": period, "phase_deg": phase,
            }  # fmt: skip
        case "scale_hysteresis":
            return lambda a: {"kind": kind, "width_mm": 0.02 * abs(a)}
        case "drift":
            return lambda a: {"kind": kind, "mm_per_hour": 0.5 * sign * a}
        case "thermal_links" | "thermal_scale":
            part = kind.removeprefix("thermal_") + "_um_per_m_per_k"
            return lambda a: {"kind": "thermal_growth", "rise_k": 8.0, "tau_s": tau, part: 12.0 * a}
    raise ValueError(f"no such kind: {kind}")


def _without_a_name(kind: str, rng: np.random.Generator, joint: int, sign: float, phase: float) -> Make:
    x, y = float(rng.uniform(-150.0, 150.0)), float(rng.uniform(-750.0, -660.0))
    rho = float(rng.uniform(530.0, 620.0))
    on_joint: Table = {"kind": kind, "joint": joint}
    shapes: dict[str, tuple[Table, str, float]] = {
        "base_flex": ({"kind": kind, "roll_deg": 0.0}, "sideways_mm", 0.15 * sign),
        "platform_tilt": ({"kind": kind}, "deg_at_reach", 0.16 * sign),
        "platform_yaw": (on_joint, "share", 0.006 * sign),
        "link_bend": ({"kind": kind}, "mm_at_horizontal", 0.3),
        "bearing_runout": ({**on_joint, "phase_deg": phase}, "amplitude_mm", 0.04),
        "encoder_ellipse": ({**on_joint, "phase_deg": phase}, "amplitude_deg", 0.004),
        "cable_torque": (on_joint, "deg_at_end", 0.012 * sign),
        "cable_windup": ({**on_joint, "winds": int(sign)}, "deg_at_end", 0.02),
        "stiffening_sag": ({"kind": kind}, "deg_at_horizontal", 0.03),
        "axis_tilt": ({**on_joint, "towards_deg": phase}, "tilt_deg", 1.3),
        "belt_stretch": (on_joint, "deg_at_horizontal", 0.015),
        "worn_sector": ({**on_joint, "at_deg": float(rng.uniform(-30.0, 30.0))}, "deg", 0.008 * sign),
        "guide_sag": ({"kind": kind}, "mm_at_corner", 0.02 * sign),
        "cable_drag": (on_joint, "deg_at_end", 0.02),
        "slider_drag": ({"kind": kind}, "width_mm", 0.02),
        "sticky_patch": ({"kind": kind, "x_mm": x, "y_mm": y, "radius_mm": 50.0}, "width_mm", 0.05),
        "stiction_patch": ({"kind": kind, "x_mm": x, "y_mm": y, "radius_mm": 30.0}, "depth_mm", 0.05),
        "field_bump": ({"kind": kind, "rho_mm": rho, "half_width_mm": 10.0}, "height_mm", 0.02 * sign),
        "magnetised_spot": ({"kind": kind, "rho_mm": rho}, "peak_mm", 0.025 * sign),
        "random_walk": ({"kind": kind}, "mm_per_stop", 0.003),
        "wandering_zero": (on_joint, "deg_per_stop", 0.001),
        "mounting_creep": ({"kind": kind}, "mm_per_decade", 0.033 * sign),
        "room_cycle": (
            {"kind": kind, "period_s": float(rng.uniform(25.0, 90.0)), "phase_deg": phase},
            "amplitude_mm",
            0.014,
        ),
        "base_gradient": (on_joint, "out_mm", 0.06 * sign),
        "arm_coupling": (on_joint, "deg_at_horizontal", 0.016 * sign),
        "sinking_bearing": (on_joint, "mm_per_min", 0.07 * sign),
        "slipping_link": ({**on_joint, "from_stop": int(rng.integers(20, 100))}, "mm", 0.04 * sign),
        "loose_head": ({"kind": kind}, "sd_mm", 0.01),
        "readout_lag": ({"kind": kind}, "share", 0.00015),
        "rest_by_distance": (on_joint, "deg", 0.0035),
        "speed_stiction": (on_joint, "deg", 0.0065),
        "reversal_slip": (on_joint, "deg_up", 0.003),
        "loose_elbow": (on_joint, "mm", 0.017),
    }
    table, key, usual = shapes[kind]
    if kind == "reversal_slip":
        return lambda a: [{**table, key: usual * a, "deg_down": 0.0028 * a}]
    return lambda a: [{**table, key: usual * a}]
