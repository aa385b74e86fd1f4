"""The results of the study, as parts of docs/accuracy.md."""

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
The machines are drawn from the tolerances of the robot file: zero offsets uniform within 3 degrees, geometry
and mounting error normal. Each reading has five samples. The servos have the scatter of eq. 35, rounded to
whole pulses, and the scale has the noise of eq. 34. Position errors are those of the true geometry of the
emulated machine, on a grid of 13 x 9 positions.

`python -m station.studies.plans --out docs/accuracy.md` makes this page; `--resume FOLDER` continues an
earlier calculation. Each part states its sample size.

- *largest*: the largest position error over the workspace with only the zero offsets in the drives; the
  median with its standard error.
- *allowed*: the same for an estimator at the Cramer-Rao bound with prior, drawn from the linear model.
- *bound*: the median of the 95 % bound that a run states.
- *kept*: the share of machines whose error is below their bound, with the zero offsets only and with the
  commands of the model."""
_KEPT = "| case | largest, mm | allowed, mm | ratio | bound, mm | kept, zeros only | kept, model |"


def time_table() -> str:
    """The predicted duration of each plan."""
    robot = robot_of(0.03)
    lines = [
        "## Time",
        "",
        "| plan | readings | travel, degrees | predicted duration, s |",
        "|---|---|---|---|",
    ]
    for name in PLANS:
        plan = make_plan(name, robot)
        told = plan.predicted
        lines.append(f"| {name} | {len(plan.stops)} | {told.travel_deg:.0f} | {told.duration_s:.1f} |")
    return (
        "\n".join(lines) + "\n\nAt 30 degrees per second. For `two_mounts`: one of the two mounting points."
    )


def counted(text: str, found: Sequence[object]) -> str:
    """A part with its number of machines or fleets."""
    return f"*Sample size: {len(found)}*\n\n{text}"


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
    """Plan `adaptive` with a correct memory."""
    readings, seconds = [one.readings for one in found], [one.machine_s for one in found]
    kept = [one.kept for one in found]
    return (
        f"**Plan `adaptive`** after a collision, wanted accuracy {WISH} of the bound of the full run before:"
        f" {np.median(readings):.0f} readings (90 %: {np.quantile(readings, 0.9):.0f}),"
        f" {np.median(seconds):.1f} s (90 %: {np.quantile(seconds, 0.9):.1f}); the memory was used in"
        f" {share([one.memory_used for one in found])}, the wanted accuracy was reached in"
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
        "A wrong memory (mechanism remounted 1 mm off in a random direction, or a link changed by 0.3 mm)"
        f" was used in {sum(one.let_through for one in clear)} of the {len(clear)} cases that a full run with"
        f" one sample per reading would see at {CLEAR_SDS:.0f} standard deviations or more, and in"
        f" {len(through)} of the other {dim} (in brackets: standard deviations)"
        f"{': ' + listed if through else ''}."
    )


def checks_table(found: Sequence[Checked]) -> str:
    """Plan `check`: its own limits, and the receiver operating curve."""
    own = np.mean([one.found for one in found], axis=0)
    heads = " | ".join(f"{size:g} of it detected" for size in SIZES)
    smallest_deg = np.median([one.smallest_deg for one in found])
    lines = [
        f"**Plan `check`**: the stated smallest shift is {smallest_deg:.4f} degrees.",
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
    """Predicted and actual gains."""
    every = list(chain.from_iterable(found))
    lines = [
        "**Advice** that was followed: decrease of the bound, mean over machines.",
        "",
        "| advice | given | predicted, mm | measured, mm | ratio | largest before, mm | after, mm |",
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
        f"**`translate`** after a collision and a second full run: {share(held)} of {len(every)} taught"
        f" positions are within their stated 95 % uncertainty; deviation {off_mm:.4f} mm,"
        f" stated {u95_mm:.4f} mm (medians)."
    )


def fleet_table(found: Sequence[Sequence[NextOne]]) -> str:
    """Robots without earlier runs, after a number of robots of their type."""
    every = list(chain.from_iterable(found))
    lines = [
        f"Robots of one type share {100.0 * (1.0 - OWN**2):.0f} % of the variance of their tolerance. Plan"
        f" `adaptive`, wanted accuracy {FLEET_WISH} of the bound of a full run of the same robot without the"
        " others.",
        "",
        "| earlier robots | next robots | readings (90 %) | wanted accuracy reached | largest, mm |"
        " bound, mm | kept, zeros only | kept, model | another type refused |",
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
