"""Tables 3 to 9 and the data of Fig. 9 and 12 from the trials, the print beside them.

A row's `results` name method ("paper" as published, "ours"), variant (`station.studies.reproduce.trial`) and
noise; every figure in them is {median, p5, p95} over the seeds.  The row's own figures are the
published method under the noise the print agrees with: the scale's alone.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from station.five_bar import SIZE
from station.records import Real
from station.studies.reproduce import printed
from station.studies.reproduce.position_error import before, edge, position_errors
from station.studies.reproduce.statistics import Spread, spread
from station.studies.reproduce.trial import OURS, PAPER, Conditions, Outcome
from station.studies.simulation import Servo

NOISES: dict[Servo, str] = {"exact": "scale", "whole pulses": "scale and servo"}
Trials = Mapping[tuple[int, Servo], Mapping[str, Sequence[Outcome]]]
"""By group and servo, by variant: one outcome a seed."""
Row = dict[str, Any]
Measure = Callable[[Outcome, int], Any]
"""A named figure of one outcome of one group: a number or a pair."""
SIMULATED = "simulated here; the print was measured on the authors' machine"


def tables(trials: Trials) -> dict[str, list[Row]]:
    """{table3: [...], ..., table9: [...]}"""
    home_measures: dict[str, Measure] = {
        "after_mm": lambda o, _: o.home_mm,
        "zero_offsets_deg": lambda o, _: o.dtheta_deg,
        "delta_deg": lambda o, g: np.abs(o.dtheta_deg - _set_deg(g)),
    }
    six_measures: dict[str, Measure] = {"after_mm": lambda o, _: o.six_mm}
    edge_measures: dict[str, Measure] = {"after_mm": lambda o, _: float(o.edge_mm.max())}
    drm_measures: dict[str, Measure] = {"delta_mm": lambda o, _: np.abs(_pair(o.drm) - printed.DRM_MM)}
    found_measures: dict[str, Measure] = {"drm_mm": lambda o, _: _pair(o.drm)}
    kappa_measures: dict[str, Measure] = {
        "kappa_m": lambda o, _: float(np.mean([p.condition for p in o.passes[1:]]))
    }
    table = _Table(trials)
    return {
        "table3": table.rows(home_measures, [_home_print(row) for row in printed.TABLE_3], "home_mm"),
        "table4": table.rows(
            six_measures, _before_after(printed.TABLE_4_BEFORE_MM, printed.TABLE_4_AFTER_MM), "six_mm"
        ),
        "table5": table.rows(drm_measures, [{"delta_mm": list(row)} for row in printed.TABLE_5_MM]),
        "table6": table.rows(kappa_measures, [{"kappa_m": kappa} for kappa in printed.TABLE_6], ours=False),
        "table7": table.rows(
            home_measures, [_home_print(row) for row in printed.TABLE_7], "home_mm", SIMULATED
        ),
        "table8": table.rows(
            found_measures, [{"drm_mm": list(row)} for row in printed.TABLE_8_MM], label=SIMULATED
        ),
        "table9": table.rows(
            edge_measures,
            _before_after(printed.TABLE_9_BEFORE_MM, printed.TABLE_9_AFTER_MM),
            "edge_mm",
            SIMULATED,
        ),
    }


@dataclass(frozen=True)
class _Table:
    trials: Trials

    def rows(
        self,
        measures: Mapping[str, Measure],
        prints: Sequence[Row],
        without: str = "",
        label: str = "",
        *,
        ours: bool = True,
    ) -> list[Row]:
        """One row a group; `without` names the error before calibration, `label` what the row is not."""
        out = []
        for group, paper in enumerate(prints, start=1):
            results = list(self._results(group, measures, ours))
            own = {name: _medians(results[0][name]) for name in measures}
            given = {"before_mm": before(group)[without]} if without else {}
            named = {"label": label} if label else {}
            out.append({"group": group, **named, **given, **own, "paper": paper, "results": results})
        return out

    def _results(self, group: int, measures: Mapping[str, Measure], ours: bool) -> Iterator[Row]:
        for servo, noise in NOISES.items():
            for variant, outcomes in self.trials[group, servo].items():
                if variant in OURS and not ours:
                    continue
                figures = {
                    name: _spreads([measure(outcome, group) for outcome in outcomes])
                    for name, measure in measures.items()
                }
                method = "ours" if variant in OURS else "paper"
                yield {"method": method, "variant": variant, "noise": noise, **figures}


def _spreads(values: Sequence[Any]) -> Spread | list[Spread]:
    array = np.array(values)
    return spread(array) if array.ndim == 1 else [spread(column) for column in array.T]


def _medians(spreads: Spread | list[Spread]) -> float | list[float]:
    return [s["median"] for s in spreads] if isinstance(spreads, list) else spreads["median"]


def _pair(z: complex) -> Real:
    return np.array([z.real, z.imag])


def _set_deg(group: int) -> Real:
    return np.array(printed.ZERO_OFFSETS_DEG[(group - 1) % 3])


def _home_print(row: printed.HomeRow) -> Row:
    return {
        "zero_offsets_deg": list(row.compensation_deg),
        "delta_deg": list(row.delta_deg),
        "before_mm": row.before_mm,
        "after_mm": row.after_mm,
    }


def _before_after(before_mm: Sequence[float], after_mm: Sequence[float]) -> list[Row]:
    return [{"before_mm": b, "after_mm": a} for b, a in zip(before_mm, after_mm, strict=True)]


def fig9(trials: Trials) -> list[Row]:
    """[{group, noise, m, dtheta1_deg: [spread a pass], dtheta2_deg, mu_deg, converged}]; mu from m = 2 on."""
    rows = []
    for (group, servo), outcomes in trials.items():
        if servo not in NOISES:
            continue
        runs = outcomes[PAPER]
        totals = np.array([[p.total_deg for p in o.passes] for o in runs])
        mu = np.array([[p.mu_deg for p in o.passes[1:]] for o in runs], dtype=float)
        rows.append(
            {
                "group": group,
                "noise": NOISES[servo],
                "m": list(range(1, totals.shape[1] + 1)),
                "dtheta1_deg": [spread(v) for v in totals[:, :, 0].T],
                "dtheta2_deg": [spread(v) for v in totals[:, :, 1].T],
                "mu_deg": [spread(v) for v in mu.T],
                "converged": float(np.mean([o.converged for o in runs])),
            }
        )
    return rows


def fig12(trials: Trials) -> list[Row]:
    """[{group, x_mm, y_mm, before_mm, after: [{variant, noise, median_mm, p95_mm}]}], 42 places each."""
    rows = []
    for group in printed.MEASURED_GROUPS:
        conditions = Conditions(group, "exact")
        places = edge(conditions.robot)
        errors = position_errors(conditions.robot, conditions.truth, np.zeros(SIZE), places)
        after = []
        for servo, noise in NOISES.items():
            for variant, outcomes in trials[group, servo].items():
                at = np.array([o.edge_mm for o in outcomes])
                median, p95 = np.percentile(at, (50, 95), axis=0)
                after.append(
                    {
                        "variant": variant,
                        "noise": noise,
                        "median_mm": median.tolist(),
                        "p95_mm": p95.tolist(),
                    }
                )
        rows.append(
            {
                "group": group,
                "x_mm": places.real.tolist(),
                "y_mm": places.imag.tolist(),
                "before_mm": errors.tolist(),
                "after": after,
            }
        )
    return rows
