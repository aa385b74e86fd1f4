"""Which effects can be stated: their probabilities, summed over all explanations that contain them.

An explanation may contain an error that the readings do not require: it is as probable without it as with it.
Such an error is not stated. The remaining errors are the *core* of the explanation.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.special import logsumexp

from station.diagnosis.explanations.aliases import aliases
from station.diagnosis.explanations.evidence import Choice
from station.diagnosis.explanations.search import Key
from station.diagnosis.explanations.weighing import Weighing

SUPPORTED = 3.0
"""Log of the evidence that an error must add before it is stated."""
BESIDE_UNNAMED = 0.05
"""Trust in a named effect that is found beside an unnamed one.

On 59 kinds of random machines, 15 of 385 such effects were real.
"""
NEGLIGIBLE = 1e-5
PartKey = tuple[str, int | None, str | None]


@dataclass(frozen=True)
class Statements:
    """Cores with their probabilities, most probable first."""

    weighing: Weighing
    cores: tuple[tuple[Key, float], ...]

    @property
    def base(self) -> float:
        """Probability of no error that the readings require."""
        return dict(self.cores).get((), 0.0)

    @cached_property
    def unnamed(self) -> float:
        """Probability that an unnamed error is involved."""
        return sum(p for key, p in self.cores if not self.named(key))

    def named(self, key: Key) -> bool:
        return all(self.weighing.families[k].named for k in key)

    def _trust(self, key: Key) -> float:
        """The trust in the names of a core.

        Beside an unnamed error a named one may only fill what the other's shape does not describe.
        """
        return 1.0 if self.named(key) else BESIDE_UNNAMED

    def parts(self, key: Key) -> set[PartKey]:
        """The contents of a core."""
        return set().union(*(self.weighing.families[k].keys for k in key)) if key else set()

    def probability(self, part: PartKey, also: Iterable[int] = ()) -> float:
        """Probability that an effect, or one of the families of its alias set, is present."""
        others = set(also)
        return sum(
            p * self._trust(key) for key, p in self.cores if part in self.parts(key) or others & set(key)
        )

    @cached_property
    def marginals(self) -> dict[PartKey, float]:
        """The probability of every named effect in any core."""
        out: dict[PartKey, float] = {}
        for key, p in self.cores:
            for part in self.parts(key):
                if part[0] != "unnamed":
                    out[part] = out.get(part, 0.0) + p * self._trust(key)
        return out

    def aliases(self, choices: tuple[Choice, ...], index: int) -> tuple[int, ...]:
        """Named families that these readings cannot distinguish from one error of a set, nor exclude."""
        held = {k for key, p in self.cores if p >= 0.01 for k in key}
        alike = aliases(self.weighing.bank, choices, index)
        return tuple(k for k in alike if k in held)


def statements(weighing: Weighing) -> Statements:
    """The cores of all explanations."""
    total = float(logsumexp(list(weighing.log_posterior.values())))
    evidence = {key: lp - weighing.candidates[key].log_prior for key, lp in weighing.log_posterior.items()}
    cores: dict[Key, float] = {}
    for key, lp in weighing.log_posterior.items():
        p = float(np.exp(lp - total))
        if p < NEGLIGIBLE:
            continue
        core = _core(key, evidence)
        cores[core] = cores.get(core, 0.0) + p
    known = sum(cores.values())
    ordered = sorted(((key, p / known) for key, p in cores.items()), key=lambda item: -item[1])
    return Statements(weighing, tuple(ordered))


def _core(key: Key, evidence: dict[Key, float]) -> Key:
    """Remove, one by one, the error that adds least, while it adds nothing relevant."""
    while key:
        smaller = [fewer for k in range(len(key)) if (fewer := key[:k] + key[k + 1 :]) in evidence]
        if not smaller:
            return key
        best = max(smaller, key=lambda fewer: evidence[fewer])
        if evidence[key] - evidence[best] > SUPPORTED:
            return key
        key = best
    return key
