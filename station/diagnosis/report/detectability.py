"""The detection limits of these readings: the smallest detectable size of every effect not found."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.special import fdtri, ncfdtrinc

from station.diagnosis.search import INVISIBLE_SHARE, SIGNIFICANT, Scan
from station.effects import Effect, Variants
from station.model import Fit
from station.records import Phrase, Quantity, SmallestVisible, phrase

POWER = 0.8


def detectable(fit: Fit, effects: Sequence[Effect]) -> tuple[SmallestVisible, ...]:
    """The limit of every effect of the catalogue that is not in the fit."""
    present = {term.effect.label for term in fit.model.terms}
    scan = Scan(fit)
    return tuple(_one(scan, effect, len(effects)) for effect in effects if effect.label not in present)


def _one(scan: Scan, effect: Effect, tests: int) -> SmallestVisible:
    variants = effect.variants(scan.fit.conditions)
    if variants is None:
        return _visible(effect, None, phrase("cannot_show"))
    if variants.spread is not None:
        return _of_many(scan, effect, variants, tests)
    _, share, information = scan.reductions(variants, variants.basis)
    visible = share >= INVISIBLE_SHARE
    if not visible.any():
        return _visible(effect, None, phrase("taken_up"))
    size = variants.basis.shape[2]
    # compared variants differ only in the values of their hidden parameters, not in the place of action
    kind = variants.hidden[int(np.argmax(visible))].keys()
    alike = [k for k, hidden in enumerate(variants.hidden) if visible[k] and hidden.keys() == kind]
    typical = sorted(alike, key=lambda k: information[k])[len(alike) // 2]
    amplitude = np.zeros(size)
    amplitude[0] = np.sqrt(_noncentrality(scan, variants, size, tests) / information[typical])
    shown = effect.quantities(variants.hidden[typical], amplitude, np.zeros((size, size)))[0]
    return _visible(effect, shown, None if len(alike) == 1 else phrase("typical"))


def _of_many(scan: Scan, effect: Effect, variants: Variants, tests: int) -> SmallestVisible:
    """The limit for many amplitudes together: of the shape that is detected best."""
    values, vectors = np.linalg.eigh(scan.information(variants)[0])
    amplitudes = vectors[:, -1] * np.sqrt(_noncentrality(scan, variants, 1, tests) / values[-1])
    size = len(amplitudes)
    shown = effect.quantities(variants.hidden[0], amplitudes, np.zeros((size, size)))[0]
    return _visible(effect, shown, phrase("best_shape"))


def _noncentrality(scan: Scan, variants: Variants, size: int, tests: int) -> float:
    """Noncentrality of the F test at which it is passed with `POWER`, look-elsewhere and Holm included."""
    dof = max(scan.fit.dof - size, 1)
    level = SIGNIFICANT / (tests * variants.trials)
    critical = float(fdtri(size, dof, 1.0 - level))
    return float(ncfdtrinc(size, dof, 1.0 - POWER, critical))


def _visible(effect: Effect, smallest: Quantity | None, said: Phrase | None) -> SmallestVisible:
    return SmallestVisible(
        effect=effect.id,
        joint=effect.joint,
        label=effect.label,
        parameter=smallest.name if smallest else None,
        minimum_detectable=None if smallest is None else abs(smallest.value),
        unit=smallest.unit if smallest else None,
        text=said.text() if said else "",
        said=said,
    )
