"""The explanation engine against random machines of the emulator: what is said, and whether it is true.

python -m station.confusion.explained 20 [kind ...]
"""

from __future__ import annotations

import sys
import time
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from station.diagnosis import ExplanationSet, explain
from station.five_bar import FiveBar, Robot, inverse
from station.studies.confusion.machines import CATALOGUE, NAMES, OUTSIDE, PAIRS, Drawn, draw
from station.studies.simulation import SimulatedMachine

Cause = tuple[str, int | None]
NATURAL = ("both_L", "both_l", "both_sag", "both_gain", "both_eccentric", "distal_2mm", "distal_5mm")
"""Kinds of this study beside those of `station.confusion.machines`: natural pairs and long links."""
RUN_UP_DEG = 1.0
CLEAR_UM = 3.4


@dataclass(frozen=True)
class Outcome:
    """What was said of one machine."""

    kind: str
    first: bool
    """The most probable explanation is the truth: for causes outside the catalogue, that it is unnamed."""
    named: bool
    """Confirmed, and every cause is among the findings."""
    wrong: bool
    """Confirmed, and something that is not in the machine is among the findings, beyond its alias set."""
    clear: bool
    off_sd: float
    """Larger error of both zero offsets in standard deviations."""
    sd_deg: float
    inside_95: int
    """Of both zero offsets, how many lie within 1.96 standard deviations."""
    statements: tuple[tuple[float, bool], ...]
    """Probability stated for each named effect and whether it is there."""
    position_mm: tuple[float, float, float, float]
    """True rms before and after, largest after, and the bound stated for it."""
    said: str
    seconds: float


def judge(kind: str, truth: set[Cause], drawn: Drawn, found: ExplanationSet, seconds: float) -> Outcome:
    """Compare what was said with what is in the machine; a cause outside the catalogue has no name."""
    outside = not truth and kind != "none"
    core = found.statements.cores[0][0]
    families = [found.weighing.families[k] for k in core]
    held = {(part[0], part[1]) for f in families for part in f.keys}
    first = held == truth if not outside else any(not f.named for f in families) or not families
    sets = [{(f.part.effect, f.part.joint), *((a[0], a[1]) for a in f.alias_set)} for f in found.findings]
    confirmed = found.decision.verdict == "explained" and found.decision.confirmed is True
    named = confirmed and all(any(c in s for s in sets) for c in truth) and bool(truth)
    wrong = confirmed and any(not (s & truth) for s in sets)
    zeros = found.parameters[:2]
    error = np.array([q.value for q in zeros]) - np.degrees(drawn.machine.truth[:2])
    sd = np.array([q.sd for q in zeros])
    said = ", ".join(f"{f.part.effect}{f.part.joint or f.part.part or ''}" for f in found.findings)
    statements = tuple(
        (p, (part[0], part[1]) in truth) for part, p in found.statements.marginals.items() if p >= 0.02
    )
    return Outcome(
        kind, first, named, wrong, all(s > CLEAR_UM for s in drawn.size_um),
        float(np.max(np.abs(error / sd))), float(np.mean(sd)), int(np.sum(np.abs(error) < 1.96 * sd)),
        statements, _positions(drawn, found), f"{found.decision.verdict}: {said}", seconds,
    )  # fmt: skip


def _positions(drawn: Drawn, found: ExplanationSet) -> tuple[float, float, float, float]:
    place = found.mechanism.robot.workspace_grid(7, 5)
    approach = np.random.default_rng(0).choice([-1.0, 1.0], (len(place), 2))
    start = found.weighing.by_key[()].x[:2]
    out = []
    for theta in (inverse(found.mechanism.nominal, place) - start, found.commands(place, approach)):
        degrees = np.degrees(theta)
        stops = np.stack([degrees - RUN_UP_DEG * approach, degrees], axis=1).reshape(-1, 2)
        out.append(np.abs(drawn.machine.stand(stops)[1::2] - place))
    rms = [float(np.sqrt(np.mean(e**2))) for e in out]
    return rms[0], rms[1], float(out[1].max()), found.position_error[1].bound_95


def machine(kind: str, seed: int) -> tuple[Drawn, set[Cause]]:
    """A machine of one kind with its causes; those outside the catalogue have none."""
    robot = Robot.default()
    if kind not in NATURAL:
        kinds = () if kind == "none" else tuple(kind.split("+"))
        drawn = draw(robot, kinds, seed)
        return drawn, {(NAMES.get(e, e), j) for e, j in drawn.truth if e not in OUTSIDE}
    rng = np.random.default_rng(seed)
    effects, truth = natural(kind, rng)
    p = np.concatenate(
        [
            rng.uniform(-0.035, 0.035, 2),
            rng.normal(0.0, 0.025, 8),
            [rng.normal(1, 0.06), rng.normal(0.5, 0.04)],
        ]
    )
    made = SimulatedMachine(robot, p, "whole pulses", seed, effects)
    walk, fresh = made.diagnostic_run(robot, seed)
    return Drawn(walk, fresh, (), (99.0,), made), truth


def natural(kind: str, rng: np.random.Generator) -> tuple[list[dict[str, Any]], set[Cause]]:
    """Effects as tables of a rig file, and the causes."""
    sign, joint = float(rng.choice([-1, 1])), int(rng.integers(1, 3))
    both = (1, 2)
    if kind.startswith("both_") and kind[-1] in "Ll":
        mm = sign * float(rng.uniform(0.7, 1.5))
        effects = [{"kind": "link_length", "joint": i, "link": kind[-1], "mm": mm} for i in both]
        return effects, {("link_length", 1), ("link_length", 2)}
    if kind.startswith("distal"):
        mm = sign * (2.0 if "2" in kind else 5.0)
        return [{"kind": "link_length", "joint": joint, "link": "l", "mm": mm}], {("link_length", joint)}
    effect, table = {
        "both_sag": ("compliance", {"deg_at_horizontal": float(rng.uniform(0.04, 0.12))}),
        "both_gain": ("transmission_gain", {"ppm": sign * float(rng.uniform(2e3, 1e4))}),
        "both_eccentric": ("encoder_eccentricity", {"amplitude_deg": 0.05}),
    }[kind]
    phases = [{"phase_deg": float(rng.uniform(0, 360))} if "ecc" in kind else {} for _ in both]
    effects = [{"kind": effect, "joint": i, **table, **phase} for i, phase in zip(both, phases, strict=True)]
    return effects, {(effect, 1), (effect, 2)}


def run(kind: str, seed: int) -> Outcome:
    """One machine."""
    drawn, truth = machine(kind, seed)
    mechanism = FiveBar(Robot.default(), drawn.walk)
    begin = time.process_time()
    found = explain(mechanism, drawn.fresh)
    found.position_error  # noqa: B018 - a part of every diagnosis
    return judge(kind, truth, drawn, found, time.process_time() - begin)


def table(outcomes: Sequence[Outcome]) -> str:
    """One line a kind."""
    by_kind: dict[str, list[Outcome]] = defaultdict(list)
    for o in outcomes:
        by_kind[o.kind].append(o)
    head = "kind | first | clear: named | wrong | >2 sd | >3 sd | in 95 % | sd deg | mm | beyond | ms"
    lines = [head]
    for kind, some in [*by_kind.items(), ("all", list(outcomes))]:
        n, clear = len(some), [o for o in some if o.clear]
        positions = np.median([o.position_mm for o in some], axis=0)
        lines.append(
            f"{kind} | {sum(o.first for o in some)}/{n} | {sum(o.named for o in clear)}/{len(clear)} "
            f"| {sum(o.wrong for o in some)} | {sum(o.off_sd > 2 for o in some)} "
            f"| {sum(o.off_sd > 3 for o in some)} "
            f"| {sum(o.inside_95 for o in some) / (2 * n):.3f} | {np.median([o.sd_deg for o in some]):.3f} "
            f"| {positions[0]:.2f} {positions[1]:.2f} {positions[2]:.2f} "
            f"| {sum(o.position_mm[2] > o.position_mm[3] for o in some)} "
            f"| {1e3 * np.median([o.seconds for o in some]):.0f}"
        )
    return "\n".join(lines)


def reliability(outcomes: Sequence[Outcome], bins: int = 10) -> str:
    """Stated and observed, in bins of equal count."""
    said = np.array(sorted(s for o in outcomes for s in o.statements))
    parts = [b for b in np.array_split(said, bins) if len(b)]
    return "\n".join(f"{b[:, 0].mean():.3f} stated, {b[:, 1].mean():.3f} true of {len(b)}" for b in parts)


def main(arguments: Sequence[str]) -> None:
    """Print the study of so many machines of every kind, or of those named."""
    count = int(arguments[0])
    every = ("none", *CATALOGUE, *("+".join(p) for p in PAIRS), *NATURAL, *OUTSIDE)
    outcomes = []
    for kind in arguments[1:] or every:
        for seed in range(count):
            outcome = run(kind, 7001 + seed)
            outcomes.append(outcome)
            if outcome.wrong or outcome.off_sd > 3.0 or (outcome.clear and not outcome.first):
                print(f"  {kind} {7001 + seed}: {outcome.said}, {outcome.off_sd:.1f} sd", flush=True)
        print(table([o for o in outcomes if o.kind == kind]).splitlines()[1], flush=True)
    print(table(outcomes))
    print(reliability(outcomes))


if __name__ == "__main__":
    main(sys.argv[1:])
