"""Every kind of mistake as an explanation; the one that makes the readings agree beyond chance."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from station.diagnosis.mistakes import gross
from station.diagnosis.mistakes.defects import (
    WithoutAMistake,
    both_gains,
    gain,
    scale_gain,
    without_a_mistake,
)
from station.diagnosis.mistakes.duplicates import copies
from station.diagnosis.mistakes.entries import entries, zero_at, zeroed
from station.diagnosis.mistakes.fitting import Extra, Fitted, Rough, fit
from station.diagnosis.mistakes.fresh import between, on_mounts
from station.diagnosis.mistakes.glitches import glitches
from station.diagnosis.mistakes.labels import approach_columns, approach_missing, position_labels, time_column
from station.diagnosis.mistakes.mistake import Context, Mistake, ids, named
from station.diagnosis.mistakes.resolution import coarse_angles, commanded_angles, is_coarse, off_grid
from station.fitting import MINIMUM_DOF, pure_error
from station.five_bar import FiveBar, Robot
from station.records import Measurements, phrase

FAR_BETTER = 60.0
"""Gain in deviance that a mistake needs over any explanation without one (e^30 times more probable)."""
MECHANISM_BETTER, CLEARLY = 40.0, 12.0
AS_GOOD = 20.0
BEYOND_OTHERS = 6.0
QUIET = 1.25
"""Noise over the specification up to which a file is not searched further."""
GROSS_MM = 0.15
"""Residual from which rows, units and columns are tried."""
HOPELESS = 5.5
"""Rough cost, of rows nearly a millimetre off, from which no exact fit is tried."""
FAR_MM = 1.0
"""and from which they are tried first: wrong numbers in the robot file seldom have as large an effect."""
SETTLED, SETTLED_MM = 1.0, 4e-3
"""Residual over the specified noise, or in mm, at which nothing else is tried."""
TRIES = 2.0 * float(np.log(100.0))
"""Price of the search over corrections, in deviance; the price over runs of rows is added."""
FEWEST = 8


@dataclass(frozen=True)
class _Candidate:
    deviance: float
    mistake: Mistake | None
    rms_mm: float


def find_mistake(
    robot: Robot,
    measurements: Measurements,
    fresh: Measurements | None = None,
    context: Context | None = None,
    *,
    explained: bool = False,
) -> Mistake | None:
    """The mistake in these files that makes them agree, or none.

    :param measurements: a file read without `Mechanism.check`, which refuses what is reported here
    :param fresh: fresh readings, read in the same way
    :param context: what the file recorded; if omitted, it is inferred from the numbers
    :param explained: the diagnosis accounts for the readings already, so that small wrong entries need no
    search; this saves a quarter of a second on a machine with a defect
    """
    m = measurements
    if len(m) < FEWEST or m.joints != 2:
        return None
    context = context or Context.of(m)
    fresh = None if fresh is None else on_mounts(fresh, m)
    found = copies(robot, m, fresh, context)
    if found:
        return found
    base = fit(robot, m)
    angles = _angles(robot, m, fresh, base)
    if angles:
        return angles
    found, sequence_fit = _in_readings(robot, m, base, explained)
    if found and found.severity == "refused":
        return found
    late = None
    if fresh is not None and sequence_fit is not None and len(fresh) >= FEWEST // 2:
        late = between(robot, m, fresh, sequence_fit)
        if late:
            return late
    labels = position_labels(m, context) or time_column(m) or approach_columns(robot, m)
    if labels is None and fresh is not None:
        labels = _labels_of_fresh(robot, fresh)
    if labels is None and base is not None and not found:
        labels = approach_missing(robot, m, base, context)
    return labels or found


def _labels_of_fresh(robot: Robot, fresh: Measurements) -> Mistake | None:
    found = time_column(fresh) or position_labels(fresh, Context.of(fresh)) or approach_columns(robot, fresh)
    if found is None:
        return None
    return replace(found, file="fresh", said=phrase("in_fresh_file", mistake=found.said))


def _angles(robot: Robot, m: Measurements, fresh: Measurements | None, base: Fitted | None) -> Mistake | None:
    """Angles in either file that are rounded or commanded."""
    found = coarse_angles(robot, m, base, "readings") or commanded_angles(robot, m, base, "readings")
    if found or fresh is None or len(fresh) < FEWEST or base is None:
        return found
    beside = off_grid(robot, fresh) and not off_grid(robot, m)
    again = fit(robot, fresh, start=base.p) if beside or is_coarse(robot, fresh) else None
    if again is None:
        return None
    found = coarse_angles(robot, fresh, again, "fresh")
    if found or base.noise > QUIET or again.noise < 1.5:
        return found
    if beside:
        return Mistake(
            "commanded_angles",
            phrase("commanded_angles_fresh"),
            (),
            "refused",
            "fresh",
        )
    return None


def _in_readings(
    robot: Robot, m: Measurements, base: Fitted | None, explained: bool
) -> tuple[Mistake | None, Fitted | None]:
    """The mistake in the sequence, and a fit to compare fresh readings with."""
    if base is not None:
        beyond = zero_at(robot, m, base)
        quiet = base.rms_mm < QUIET * _repeats_mm(m, base)
        if beyond and (quiet or base.noise < QUIET):
            return beyond, base
        if (explained and base.rms_mm < GROSS_MM) or (quiet and not _strained(robot, m, base)):
            return glitches(robot, m, base, Rough(base.p, base.residual_mm), "readings"), base
    start = base
    agreed = Rough(base.p, base.residual_mm) if base is not None else None
    candidates: list[_Candidate] = []
    if base is None or base.rms_mm > FAR_MM:
        agreed = gross.majority(robot, m)
        candidates += _gross(robot, m, agreed)
    if base is None and agreed is not None and not _any_settles(candidates, base):
        some_rows = np.abs(agreed.residual_mm) < gross.AGREES_MM
        part = fit(robot, m, used=some_rows, start=agreed.p) if some_rows.sum() > 2 * FEWEST else None
        if part is not None:
            candidates += _entries(robot, m, part)
    if base is not None and not _any_settles(candidates, base):
        candidates += _entries(robot, m, base)
        if GROSS_MM < base.rms_mm <= FAR_MM and not _any_settles(candidates, base):
            agreed = gross.majority(robot, m)
            candidates += _gross(robot, m, agreed)
    some = (
        None
        if agreed is None or _any_settles(candidates, base)
        else glitches(robot, m, base, agreed, "readings")
    )
    named_ones = [c for c in candidates if c.mistake is not None]
    if some is not None:
        return some, start
    if not named_ones:
        return None, start
    best = min(named_ones, key=lambda c: c.deviance)
    nameless = min((c.deviance for c in candidates if c.mistake is None), default=np.inf)
    if nameless < best.deviance - BEYOND_OTHERS:
        return None, start
    if base is not None and not _far_better(best, base, without_a_mistake(robot, m, base)):
        return None, start
    return best.mistake, start


def _any_settles(candidates: list[_Candidate], base: Fitted | None) -> bool:
    """Whether a correction brings the readings to their noise, where the base model was far off."""
    if base is not None and base.rms_mm < GROSS_MM:
        return False
    limit = SETTLED_MM if base is None else SETTLED * float(np.median(base.row_sd))
    return any(c.rms_mm < limit for c in candidates if c.mistake is not None)


def _far_better(best: _Candidate, base: Fitted, without: WithoutAMistake) -> bool:
    """Whether chance and the machine's own defects are excluded.

    All smooth defects together imitate many effects of a wrong length or a displaced mechanism, with many
    sizes where the mistake has one or two: a mistake has to exceed those clearly, the plain model and single
    defects by far.
    """
    everything = without.everything - best.deviance
    if best.mistake is not None and best.mistake.severity == "as_effect":
        # an entry of a defect's size is reported if it is as probable as any other explanation
        return (
            base.deviance - best.deviance > FAR_BETTER
            and min(without.simple - best.deviance, everything) > -AS_GOOD
        )
    if best.mistake is not None and best.mistake.kind == "mechanism":
        return without.simple - best.deviance > MECHANISM_BETTER and everything > CLEARLY
    return without.simple - best.deviance > FAR_BETTER and everything > CLEARLY


def _repeats_mm(m: Measurements, base: Fitted) -> float:
    """Scatter of the repeats, mm; at most, and without enough repeats, the specification."""
    square, dof = pure_error(m, base.residual_mm)
    specified = float(np.median(base.row_sd))
    return min(float(np.sqrt(square / dof)), specified) if dof >= MINIMUM_DOF else specified


def _strained(robot: Robot, m: Measurements, base: Fitted) -> bool:
    """Whether a fit within the noise has moved a parameter far from its known value."""
    known = FiveBar(robot, m).parameters
    return any(
        abs(value - p.prior_mean) > 4.0 * p.prior_sd for value, p in zip(base.p[2:], known[2:], strict=True)
    )


def _entries(robot: Robot, m: Measurements, base: Fitted) -> list[_Candidate]:
    out = []
    for one in entries(robot, m, base):
        found = fit(robot, m, loosened=one.loosened, extras=one.extras, start=base.p)
        if found is not None:
            out.append(_Candidate(found.deviance + one.price + TRIES, one.verdict(found), found.rms_mm))
    return out


def _gross(robot: Robot, m: Measurements, agreed: Rough) -> list[_Candidate]:
    out = []
    n = len(m)
    whole = gross.whole(robot, m)
    for found in _promising(whole, agreed.cost):
        exact = _exact(robot, found)
        if exact is None:
            continue
        lost = _lost_rows(found, exact)
        mistake = _whole_file(robot, m, found, exact)
        out.append(_Candidate(exact.deviance + lost + TRIES, mistake, exact.rms_mm))
    runs = 4.0 * float(np.log(n))
    for found in _promising(gross.partial(robot, m, agreed, whole[:2]), agreed.cost):
        exact = _exact(robot, found)
        if exact is not None:
            lost = _lost_rows(found, exact)
            out.append(_Candidate(exact.deviance + lost + TRIES + runs, _part(m, found), exact.rms_mm))
    steps = gross.zeroings(robot, m, agreed)
    if steps is not None:
        extras = tuple(
            Extra(f"step{k}", 1000.0, by_reading=np.isin(np.arange(n), rows).astype(float))
            for k, rows in enumerate(steps.rows)
        )
        exact = fit(robot, m, extras=extras, start=steps.start)
        if exact is not None:
            rows = np.sort(np.concatenate(steps.rows))
            mistake = zeroed(m, rows, steps.steps_mm[0])
            out.append(_Candidate(exact.deviance + runs * len(extras), mistake, exact.rms_mm))
    return out


def _promising(found: list[gross.Found], cost: float) -> list[gross.Found]:
    """Candidates that make rows agree, and are not far worse than the best one."""
    return [one for one in found[:5] if one.cost < min(cost - 0.1, found[0].cost + 1.0, HOPELESS)]


def _exact(robot: Robot, found: gross.Found) -> Fitted | None:
    wide = (
        {"dtheta1": np.radians(20.0), "dtheta2": np.radians(20.0)}
        if found.correction.kind == "zero_at"
        else {}
    )
    scale = found.correction.kind in ("ratio", "scale_factor")
    extras: tuple[Extra, ...] = ()
    if scale:
        m = found.corrected
        extras = (both_gains(robot, m, 0.05),) if found.correction.kind == "ratio" else (scale_gain(m, 0.05),)
        if found.correction.kind == "ratio" and len(found.correction.joints) == 1:
            extras = (gain(robot, m, found.correction.joints[0], 0.05),)
    return fit(robot, found.corrected, used=found.used, start=found.start, loosened=wide, extras=extras)


def _lost_rows(found: gross.Found, exact: Fitted) -> float:
    """The cost of the excluded rows at the fit's own noise."""
    out = int((~found.used).sum())
    return out * (1.0 + 2.0 * float(np.log(exact.noise * np.median(exact.row_sd))))


def _whole_file(robot: Robot, m: Measurements, found: gross.Found, exact: Fitted) -> Mistake | None:
    one = found.correction
    if one.kind == "zero_at":
        added = np.degrees(np.median(found.corrected.theta - m.theta, axis=0))
        return zero_at(robot, m, exact, (float(added[0]), float(added[1])))
    said = phrase("agree_once_undone", rms_um=exact.rms_mm * 1e3, what=one.what, action=one.action)
    return Mistake(one.kind, said, ids(m, range(len(m))), "refused")


def _part(m: Measurements, found: gross.Found) -> Mistake:
    rows = ids(m, np.flatnonzero(found.rows))
    one = found.correction
    return Mistake(
        one.kind,
        phrase("wrong_in_rows", rows=named(rows), what=one.what, action=one.action),
        rows,
        "refused",
    )
