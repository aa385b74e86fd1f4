"""What the study found, as parts of docs/accuracy.md."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain

import numpy as np

from station.plans import make_plan
from station.records import PlanName
from station.studies.drawn import robot_of
from station.studies.plans.advised import Followed
from station.studies.plans.checks import SIZES, Checked, operating_curve
from station.studies.plans.collision import CLEAR_SDS, WISH, Misled, Struck
from station.studies.plans.fleet import OWN, NextOne
from station.studies.plans.fleet import SIZES as FLEETS
from station.studies.plans.fleet import WISH as FLEET_WISH
from station.studies.plans.promise import Kept
from station.studies.plans.references import CASES
from station.studies.plans.retaught import Retaught

PLANS: tuple[PlanName, ...] = ("full", "diagnostic", "rapid", "check", "two_mounts")
ALARMS = (0.001, 0.005, 0.01, 0.05)
ABOUT = """# What the plans reach
Machines drawn from the tolerances of the robot file (zero offsets uniform within 3 degrees, geometry and
mounting normal), five samples a reading, servos with the scatter of eq. 35 on whole pulses, scale with the
noise of eq. 34.  Positions are those of the emulated machine's own geometry, over a grid of 13 x 9.

`python -m station.studies.plans --out docs/accuracy.md` makes this page again; `--resume FOLDER` goes on from
what was done.  Each part says how many machines it is made of.

- *largest*: the largest position error over the workspace with the zeros in the drives only, a median with
  its standard error.
- *allowed*: the same of an estimator at the Cramer-Rao bound with prior, drawn from the linear model.
- *bound*: the median of the 95 % bound that a run states.
- *kept*: the share of machines below their bound, with the zeros only and with commands of the model."""
_KEPT = "| case | largest, mm | allowed, mm | ratio | bound, mm | kept, zeros only | kept, model |"


def time_table() -> str:
    """What each plan is predicted to take."""
    robot = robot_of(0.03)
    lines = ["## Time", "", "| plan | readings | travel, degrees | predicted, s |", "|---|---|---|---|"]
    for name in PLANS:
        plan = make_plan(name, robot)
        told = plan.predicted
        lines.append(f"| {name} | {len(plan.stops)} | {told.travel_deg:.0f} | {told.duration_s:.1f} |")
    return "\n".join(lines) + "\n\nAt 30 degrees a second; of `two_mounts` one mounting point of two."


def counted(text: str, found: Sequence[object]) -> str:
    """A part with the number of machines or fleets that it is made of."""
    return f"*Of {len(found)}:*\n\n{text}"


def cases_table(found: Sequence[dict[str, Kept]]) -> str:
    """Calibrations with and without references."""
    lines = [_KEPT, "|---|---|---|---|---|---|---|"]
    for case in CASES:
        kept = [one[case] for one in found]
        allowed = float(np.median([a for one in kept for a in one.allowed_mm]))
        ratio = float(np.median([one.largest_mm for one in kept])) / allowed
        lines.append(f"| {case} | {_largest(kept)} | {allowed:.3f} | {ratio:.2f} | {_promise(kept)} |")
    return "\n".join(lines)


def collision_text(found: Sequence[Struck]) -> str:
    """Plan `adaptive` with a right memory."""
    readings, seconds = [one.readings for one in found], [one.machine_s for one in found]
    kept = [one.kept for one in found]
    return (
        f"**Plan `adaptive`** after a collision, to {WISH} of the bound of the full run before:"
        f" {np.median(readings):.0f} readings (90 %: {np.quantile(readings, 0.9):.0f}),"
        f" {np.median(seconds):.1f} s (90 %: {np.quantile(seconds, 0.9):.1f}); memory used in"
        f" {share([one.memory_used for one in found])}, wish reached in"
        f" {share([one.reached for one in found])}.\n\n"
        "| largest, mm | bound, mm | kept, zeros only | kept, model |\n|---|---|---|---|\n"
        f"| {_largest(kept)} | {_promise(kept)} |"
    )


def misled_text(found: Sequence[Misled]) -> str:
    """Plan `adaptive` with a wrong memory."""
    clear = [one for one in found if one.seen_sds >= CLEAR_SDS]
    through = [one for one in found if one.let_through and one.seen_sds < CLEAR_SDS]
    dim = len(found) - len(clear)
    listed = ", ".join(
        f"{one.change} ({one.seen_sds:.1f})" for one in sorted(through, key=lambda o: o.change)
    )
    return (
        "Wrong memory (mounted anew by 1 mm in a random direction, or a link changed by 0.3 mm) let through:"
        f" {sum(one.let_through for one in clear)} of the {len(clear)} that a full run of one sample a"
        f" reading would see at {CLEAR_SDS:.0f} standard deviations or more; {len(through)} of the other"
        f" {dim}"
        f"{': ' + listed if through else ''}."
    )


def checks_table(found: Sequence[Checked]) -> str:
    """Plan `check`: its own limits, and the receiver operating curve."""
    own = np.mean([one.found for one in found], axis=0)
    heads = " | ".join(f"{size:g} of it found" for size in SIZES)
    smallest_deg = np.median([one.smallest_deg for one in found])
    lines = [
        f"**Plan `check`**: smallest shift stated {smallest_deg:.4f} degrees.",
        "",
        f"| false alarms | {heads} |",
        "|---" * (1 + len(SIZES)) + "|",
        f"| as built: {share([one.false_alarm for one in found])} | "
        + " | ".join(f"{100.0 * part:.1f} %" for part in own)
        + " |",
    ]
    for alarm, parts in zip(ALARMS, operating_curve(found, ALARMS), strict=True):
        lines.append(
            f"| {100.0 * alarm:g} % | " + " | ".join(f"{100.0 * part:.1f} %" for part in parts) + " |"
        )
    return "\n".join(lines)


def advice_table(found: Sequence[Sequence[Followed]]) -> str:
    """Predicted gains and those that came."""
    every = list(chain.from_iterable(found))
    lines = [
        "**Advice**, followed: gain of the bound, mean over machines.",
        "",
        "| advice | given | predicted, mm | happened, mm | ratio | largest before, mm | after, mm |",
        "|---|---|---|---|---|---|---|",
    ]
    for kind in dict.fromkeys(one.kind for one in every):
        of_kind = [one for one in every if one.kind == kind]
        predicted = float(np.mean([one.predicted_mm for one in of_kind]))
        happened = [one.happened_mm for one in of_kind]
        error = float(np.std(happened) / np.sqrt(len(happened)))
        before, after = (
            [getattr(one, f"largest_{when}_mm") for one in of_kind] for when in ("before", "after")
        )
        lines.append(
            f"| {kind} | {len(of_kind)} | {predicted:.4f} | {np.mean(happened):.4f} ± {error:.4f} |"
            f" {predicted / np.mean(happened):.2f} | {median(before)} | {median(after)} |"
        )
    return "\n".join(lines)


def retaught_text(found: Sequence[Sequence[Retaught]]) -> str:
    """Taught positions after a collision."""
    every = list(chain.from_iterable(found))
    held = [one.off_mm <= one.u95_mm for one in every]
    off_mm, u95_mm = (np.median(sizes) for sizes in zip(*((e.off_mm, e.u95_mm) for e in every), strict=True))
    return (
        f"**`translate`** after a collision and a second full run: of {len(every)} taught positions"
        f" {share(held)} within their stated 95 %; off by {off_mm:.4f} mm, stated {u95_mm:.4f} mm (medians)."
    )


def fleet_table(found: Sequence[Sequence[NextOne]]) -> str:
    """Robots that were never measured, after so many of their type."""
    every = list(chain.from_iterable(found))
    lines = [
        f"Robots of a type have {100.0 * (1.0 - OWN**2):.0f} % of the variance of their tolerance in common."
        f"  Plan `adaptive`, to {FLEET_WISH} of the bound of the robot's own full run without the others.",
        "",
        "| robots before | next ones | readings (90 %) | wish reached | largest, mm | bound, mm |"
        " kept, zeros only | kept, model | another type refused |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for count in FLEETS:
        next_ones = [one for one in every if one.before == count]
        readings = [one.readings for one in next_ones]
        kept = [one.kept for one in next_ones]
        refused = share([one.wrong_refused for one in next_ones]) if count else ""
        reached = share([one.reached for one in next_ones])
        lines.append(
            f"| {count} | {len(next_ones)} | {np.median(readings):.0f} ({np.quantile(readings, 0.9):.0f}) |"
            f" {reached} | {_largest(kept)} | {_promise(kept)} | {refused} |"
        )
    return "\n".join(lines)


def _largest(kept: Sequence[Kept]) -> str:
    return median([one.largest_mm for one in kept])


def _promise(kept: Sequence[Kept]) -> str:
    held = [one.largest_mm <= one.bound_mm for one in kept]
    by_model = [one.by_model_mm <= one.bound_by_model_mm for one in kept]
    return f"{np.median([one.bound_mm for one in kept]):.3f} | {share(held)} | {share(by_model)}"


def median(values: Sequence[float]) -> str:
    """With its standard error, from the order statistics of a normal approximation."""
    ordered, n = np.sort(values), len(values)
    half = np.sqrt(n) / 2.0
    low, high = ordered[max(0, int(n / 2 - half))], ordered[min(n - 1, int(n / 2 + half))]
    return f"{np.median(values):.4f} ± {(high - low) / 2.0:.4f}"


def share(hits: Sequence[bool]) -> str:
    """In percent."""
    return f"{100.0 * np.mean(hits):.1f} %"
