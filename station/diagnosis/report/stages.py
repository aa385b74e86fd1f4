"""Errors of every model in the sequence: the paper's, the base model, then one per effect added."""

from __future__ import annotations

import numpy as np

from station.diagnosis.tests_of_fit import predicted_by_others
from station.diagnosis.traced_loop import TracedDiagnosis
from station.diagnosis.unnamed_error import UnnamedError, left_by
from station.errors import InputRefused
from station.fitting import NotConvergedError, Prior, Solution, solve
from station.mechanism import Mechanism, by_reading
from station.model import Term
from station.records import Flags, Measurements, Real, StageErrors

UNNAMED = "+ unnamed smooth error of the pose"


def stage_errors(diagnosis: TracedDiagnosis) -> tuple[StageErrors, ...]:
    """Paper, base, and one more per effect found."""
    base = diagnosis.base
    kept = None if diagnosis.fresh is None else diagnosis.fresh.take(kept_fresh(diagnosis))
    stages = [simplest(base.model.mechanism, base.row_sd, base.x, kept)]
    names = ["base", *(finding.term.effect.label for finding in diagnosis.trace.findings)]
    for k, (stage, name) in enumerate(zip(diagnosis.trace.stages, names, strict=True)):
        fit = stage.fit
        fresh = None
        if diagnosis.confirmations:
            fresh = diagnosis.confirmations[k].error_mm[kept_fresh(diagnosis)]
        stages.append(
            errors_of(
                name if k == 0 else f"+ {name}",
                base_unknowns(fit.model.mechanism) + sum(len_of(term) for term in fit.model.terms),
                fit.solution,
                fit.row_sd,
                fit.model.mechanism,
                fresh,
            )
        )
    if diagnosis.unnamed is not None:
        stages.append(_with_unnamed(diagnosis, diagnosis.unnamed, stages[-1]))
    return tuple(stages)


def _with_unnamed(diagnosis: TracedDiagnosis, unnamed: UnnamedError, last: StageErrors) -> StageErrors:
    """The last model with a smooth error of the pose; its length, size and noise are unknowns."""
    fresh = None
    if diagnosis.fresh is not None:
        rows = diagnosis.confirmations[-1].residual_mm
        fresh = left_by(unnamed, diagnosis.fresh, rows)[kept_fresh(diagnosis)]
    return StageErrors(
        model=UNNAMED,
        unknowns=last.unknowns + 3,
        fit_rms_mm=_rms(np.linalg.norm(unnamed.fitted_mm, axis=1)),
        holdout_rms_mm=last.holdout_rms_mm * unnamed.share,
        holdout_max_mm=last.holdout_max_mm,
        confirm_rms_mm=None if fresh is None else _rms(fresh),
        confirm_max_mm=None if fresh is None else float(fresh.max()),
    )


def kept_fresh(diagnosis: TracedDiagnosis) -> Flags:
    """(K,) fresh readings that were used to confirm the last model."""
    if diagnosis.fresh is None:
        return np.zeros(0, dtype=bool)
    left_out = diagnosis.confirmations[-1].left_out
    return np.array([i not in left_out for i in diagnosis.fresh.ids])


def base_unknowns(mechanism: Mechanism) -> int:
    """Number of parameters of geometry and mechanism."""
    return sum(p.role != "reading_offset" for p in mechanism.parameters)


def len_of(term: Term) -> int:
    """Number of a term's parameters, the searched ones included."""
    return len(term.effect.quantities(term.hidden, np.ones(term.size), np.eye(term.size)))


def errors_of(
    model: str,
    unknowns: int,
    solution: Solution,
    row_sd: Real,
    mechanism: Mechanism,
    fresh_mm: Real | None,
) -> StageErrors:
    """Errors of one fitted model; fresh_mm (F,) are fresh readings less predicted."""
    fit_mm = by_reading(mechanism, solution.residual * row_sd)
    out_mm = by_reading(mechanism, predicted_by_others(solution, mechanism) * row_sd)
    return StageErrors(
        model=model,
        unknowns=unknowns,
        fit_rms_mm=_rms(fit_mm),
        holdout_rms_mm=_rms(out_mm),
        holdout_max_mm=float(out_mm.max()),
        confirm_rms_mm=None if fresh_mm is None else _rms(fresh_mm),
        confirm_max_mm=None if fresh_mm is None else float(np.abs(fresh_mm).max()),
    )


def simplest(mechanism: Mechanism, row_sd: Real, start: Real, later: Measurements | None) -> StageErrors:
    """The simplest model of the machine: its other parameters stay nominal, and there is no prior.

    :param start: (P,) parameters to start from
    :param later: fresh readings
    """
    name, names = mechanism.simplest
    free = np.flatnonzero([p.name in names for p in mechanism.parameters])
    nominal = mechanism.start

    def full(q: Real) -> Real:
        p = nominal.copy()
        p[free] = q
        return p

    def residuals(q: Real) -> tuple[Real, Real]:
        at = mechanism.observe(full(q), mechanism.theta)
        return (at.value - mechanism.measured) / row_sd, at.by_parameter[:, free] / row_sd[:, None]

    try:
        solution = solve(residuals, start[free], Prior(nominal[free], np.zeros((0, len(free)))))
    except NotConvergedError as error:
        raise InputRefused(
            f"Not even the {len(names)} unknowns of the {name} model converge on these readings ({error}); "
            "check the robot file and that angles and distances belong together."
        ) from error
    fresh_mm = None
    if later is not None:
        fresh = mechanism.of(later)
        rows = fresh.measured - fresh.observe(full(solution.x), fresh.theta).value
        fresh_mm = by_reading(fresh, rows)
    unknowns = sum(p.role != "reading_offset" for p in mechanism.parameters if p.name in names)
    return errors_of(name, unknowns, solution, row_sd, mechanism, fresh_mm)


def _rms(errors: Real) -> float:
    return float(np.sqrt(np.mean(errors**2)))
