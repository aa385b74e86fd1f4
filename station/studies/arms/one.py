"""One log of a random arm, and what the closed loop makes of it."""

from __future__ import annotations

import traceback
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from station.diagnosis import TracedFindings, traced, without_a_quarter
from station.errors import InputRefused
from station.records import Measurements, Real
from station.serial_arm import Arm
from station.studies.arms.physics import CRAIG_SEVEN, UR_LIKE, random_arm, random_poses
from station.studies.engine import Engine

KINDS = ("clean", "ripple", "sag", "play", "lag", "ripple and play")
FEWEST, MOST = 40, 4000
"""Poses."""
NOISES_MM = (0.005, 0.02, 0.1)


@dataclass(frozen=True, slots=True)
class Judged:
    """What came of one log."""

    kind: str
    poses: int
    measured: str
    """position or range"""
    joints: frozenset[int]
    """That err, from 1."""
    refused: str = ""
    """The sentence, where the log was not diagnosed."""
    traceback: str = ""
    """Where the loop broke: a defect of the station."""
    verdict: str = ""
    named: frozenset[int] = frozenset()
    """Joints of the effects that are named."""
    confirmed: bool = False
    """Effects are named and said to be confirmed."""
    left_out_mm: tuple[float, float] = (0.0, 0.0)
    """RMS of readings that took no part, without and with what was found."""

    @property
    def unsupported(self) -> bool:
        """A claim that readings left out do not bear, or on a joint that does not err."""
        before, after = self.left_out_mm
        return self.confirmed and (after >= before or not self.named <= self.joints)


def arms(logs: int, seed: int, engine: Engine) -> list[Judged]:
    """Of random arms with six and seven joints, in both conventions."""
    return engine.each(judged, [seed * 1_000_003 + k for k in range(logs)], "Logs", long=True)


def judged(seed: int) -> Judged:
    """Of the log with this seed."""
    drawn, arm, log = _drawn(seed)
    try:
        found = TracedFindings(traced(arm, *without_a_quarter(log)))
    except InputRefused as refusal:
        return replace(drawn, refused=str(refusal))
    except Exception:  # noqa: BLE001 - what should never happen is what is looked for
        return replace(drawn, traceback=traceback.format_exc(limit=-3))
    named = frozenset(effect.name.joint for effect in found.effects if effect.name.joint is not None)
    stages = [stage.confirm_rms_mm or 0.0 for stage in found.stages]
    return replace(
        drawn,
        verdict=found.decision.verdict,
        named=named,
        confirmed=bool(found.effects) and found.decision.confirmed is True,
        left_out_mm=(stages[0], stages[-1]),
    )


def _drawn(seed: int) -> tuple[Judged, Arm, Measurements]:
    """A log, and of what it is."""
    rng = np.random.default_rng(seed)
    table = (UR_LIKE, CRAIG_SEVEN)[int(rng.integers(2))]
    kind = str(rng.choice(KINDS))
    joints = Arm.from_dict(table).joints
    poses = int(np.exp(rng.uniform(np.log(FEWEST), np.log(MOST))))
    first = int(rng.integers(1, joints + 1))
    second = 1 + first % joints
    effects = {f"j{first}": _error(kind.split()[0], rng)} if kind != "clean" else {}
    if kind == "ripple and play":
        effects[f"j{second}"] = _error("play", rng)
    noise_mm = float(rng.choice(NOISES_MM))
    arm = random_arm({**table, "instrument": {"sd_mm": noise_mm}}, seed, **effects)
    arm.noise_mm = noise_mm
    log = arm.log(random_poses(joints, poses, seed, float(rng.uniform(40.0, 170.0))), seed)
    measured = str(rng.choice(["position", "range"]))
    if measured == "range":
        log = replace(log, tracker=None)
    return Judged(kind, poses, measured, frozenset(arm.effects)), arm.robot, log


def _error(kind: str, rng: np.random.Generator) -> Callable[[Real], Real]:
    """Of one joint, by the angles that it goes through."""
    size = np.radians(np.exp(rng.uniform(np.log(0.003), np.log(0.05))))
    per_turn, phase = float(rng.uniform(4.0, 60.0)), float(rng.uniform(0.0, 6.28))
    shapes: dict[str, Callable[[Real], Real]] = {
        "ripple": lambda theta: np.sin(per_turn * theta + phase),
        "sag": lambda theta: np.sin(theta + phase),
        "play": lambda theta: -np.sign(np.diff(theta, prepend=theta[0] - 1.0)),
        "lag": lambda theta: -np.diff(theta, prepend=theta[0]),
    }
    return lambda theta: np.asarray(size * shapes[kind](theta))
