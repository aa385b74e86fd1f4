"""Random machines with known effects, walked in virtual time.

The size of an effect is what is left of it in the readings after the kinematic parameters took their
share: its amplitude is scaled until a noise-free walk leaves that residual.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from station.fitting import NotConvergedError, tolerance_prior
from station.five_bar import FiveBar, Robot
from station.mechanism import reference_of
from station.model import Model, fit
from station.plans import make_plan
from station.records import Measurements, Real
from station.studies.simulation import SimulatedMachine

SMALLEST_UM, LARGEST_UM = 1.0, 30.0
SCATTER_UM = 1.117
"""Noise of a reading."""

Table = dict[str, Any]
Make = Callable[[float], Table]
"""Amplitude (1 is a usual size) -> the effect as a table of a rig file."""

CATALOGUE = (
    "backlash", "gear_cyclic", "encoder_eccentricity", "transmission_gain", "compliance", "count_slip",
    "link_length", "scale_gain", "scale_bow", "scale_cyclic", "scale_hysteresis", "drift", "thermal_links",
    "thermal_scale",
)  # fmt: skip
OUTSIDE = {
    "cable_drag": "approach x place",
    "slider_drag": "approach x place",
    "sticky_patch": "approach x place",
    "stiction_patch": "place",
    "field_bump": "travel",
    "random_walk": "time",
    "wandering_zero": "time",
}
"""Nothing of the catalogue, and what the strongest hint should point to."""
PAIRS = (
    ("backlash", "gear_cyclic"), ("drift", "scale_cyclic"), ("gear_cyclic", "gear_cyclic"),
    ("backlash", "drift"), ("count_slip", "scale_hysteresis"),
)  # fmt: skip
NAMES = {"thermal_links": "thermal_growth", "thermal_scale": "thermal_growth"}
"""What a kind is called in the catalogue, where it has a name of its own here."""


@dataclass(frozen=True)
class Drawn:
    """One random machine, measured."""

    walk: Measurements
    fresh: Measurements
    truth: tuple[tuple[str, int | None], ...]
    """(effect, joint) of everything in it."""
    size_um: tuple[float, ...]
    """Projected RMS of each."""
    machine: SimulatedMachine
    """As it is after all readings."""


def draw(robot: Robot, kinds: tuple[str, ...], seed: int) -> Drawn:
    """A machine with one effect of each kind, at random sizes, joints, phases and moments."""
    rng = np.random.default_rng(seed)
    truth = np.concatenate(
        [
            rng.uniform(-np.radians(2.0), np.radians(2.0), 2),
            rng.normal(0.0, 0.025, 8),
            [rng.normal(1.0, 0.06), rng.normal(0.5, 0.04)],
        ]
    )

    def with_effects(effects: list[Table], *, noise: bool = True) -> SimulatedMachine:
        return SimulatedMachine(robot, truth, "whole pulses", seed, effects, noise=noise)

    stops = make_plan("diagnostic", robot).stops

    def left(make: Make, amplitude: float) -> float:
        silent = with_effects([make(amplitude)], noise=False)
        return _left_um(robot, silent.run(stops))

    made, names, sizes = [], [], []
    for kind in kinds:
        make = _effect(kind, rng)
        size = float(np.exp(rng.uniform(np.log(SMALLEST_UM), np.log(LARGEST_UM))))
        made.append(make(_scaled(partial(left, make), size)))
        names.append((NAMES.get(kind, kind), made[-1].get("joint")))
        sizes.append(size)
    machine = with_effects(made)
    walk, fresh = machine.diagnostic_run(robot, seed)
    return Drawn(walk, fresh, tuple(names), tuple(sizes), machine)


def _scaled(left_um: Callable[[float], float], size_um: float) -> float:
    """The amplitude of which so much is left."""
    amplitude = 1.0
    for _ in range(3):
        left = left_um(amplitude)
        amplitude *= size_um / max(left, 1e-6)
        if abs(left / size_um - 1.0) < 0.05:
            break
    return amplitude


def _left_um(robot: Robot, walked: Measurements) -> float:
    """Residual RMS of a noise-free walk under the base model."""
    mechanism = FiveBar(robot, walked)
    try:
        base = fit(Model(mechanism, reference_of(walked)), tolerance_prior(mechanism), mechanism.row_sd)
    except NotConvergedError:
        return LARGEST_UM * 10.0  # far too large: the next amplitude will be smaller
    residual: Real = base.residual_mm
    return float(np.sqrt(np.mean(residual**2))) * 1e3


def _effect(kind: str, rng: np.random.Generator) -> Make:
    """Everything random but the amplitude is drawn here."""
    joint, sign = int(rng.integers(1, 3)), float(rng.choice([-1.0, 1.0]))
    phase = float(rng.uniform(0.0, 360.0))
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
        case "cable_drag":
            return lambda a: {"kind": kind, "joint": joint, "deg_at_end": 0.02 * a}
        case "stiction_patch":
            x, y = float(rng.uniform(-150.0, 150.0)), float(rng.uniform(-750.0, -660.0))
            return lambda a: {"kind": kind, "x_mm": x, "y_mm": y, "radius_mm": 30.0, "depth_mm": 0.05 * a}
        case "random_walk":
            return lambda a: {"kind": kind, "mm_per_stop": 0.003 * abs(a)}
        case "wandering_zero":
            return lambda a: {"kind": kind, "joint": joint, "deg_per_stop": 0.001 * abs(a)}
        case "slider_drag":
            return lambda a: {"kind": kind, "width_mm": 0.02 * abs(a)}
        case "sticky_patch":
            x, y = float(rng.uniform(-150.0, 150.0)), float(rng.uniform(-750.0, -660.0))
            return lambda a: {
                "kind": kind, "x_mm": x, "y_mm": y, "radius_mm": 50.0, "width_mm": 0.05 * abs(a),
            }  # fmt: skip
        case "field_bump":
            rho = float(rng.uniform(530.0, 620.0))
            return lambda a: {
                "kind": kind, "rho_mm": rho, "half_width_mm": 10.0, "height_mm": 0.02 * sign * a,
            }  # fmt: skip
    raise ValueError(f"no such kind: {kind}")
