"""The sets of up to three errors that account for the readings, searched as sets, not from one winner on.

Every family alone; beside each of the most probable ones every other; beside the most probable pairs every
third. Then the best sets are revisited: each error is exchanged for every other until nothing better is
found. The evidence of a set is that of its best members, times the price paid for each search.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from station.diagnosis.explanations.evidence import Bank, Choice, Known, Scan
from station.diagnosis.explanations.family import Family
from station.records import Real

BY_COUNT = (0.35, 0.45, 0.15, 0.05)
"""Prior probability by number of errors; a natural pair counts as one."""
FIRST, SECOND = 14, 6
"""Maximum number of sets of one and of two errors beside which others are searched."""
WITHIN = 25.0
"""Log of probability below the best within which a set is searched beside,"""
POLISHED_WITHIN = 5.0
"""and within which its evidence is settled."""
REFINED_WITHIN = 6.0
"""Log of probability below the best of a scan within which continuous hidden parameters are refined."""
REFINED = 4
"""This many of the first scan are refined in any case."""
MOST_POLISHED = 12
STRONG = 20.0
"""Log of evidence by which a second error must help to be refined at any distance from the best."""
NOTHING_FOUND = 6.0
"""Log of odds by which the best single error must exceed the base model before pairs are searched."""
ALONE_WITHIN = 20.0
"""Log of probability below a single error that leaves only noise, within which others are searched beside."""
NEARLY = 2.0
"""Log of probability below a single error that leaves only noise, within which a pair may need a third."""
NOISY = 1.25
"""Noise over the specification that still counts as noise."""
PAIRS = 3
"""Number of pairs of waves of one joint that are settled,"""
PROMISING = 0.3
"""where their evidence at the steps of the search is this share of the best single error's."""
EXCHANGES = 4
SWEEPS, SWEEPS_OF_WAVES = 3, 20
SETTLED = 0.1
"""Log of evidence by which one more sweep must help two waves."""

Key = tuple[int, ...]


@dataclass(frozen=True)
class Candidate:
    """A set of errors at their best members and sizes."""

    choices: tuple[Choice, ...]
    log_evidence: float
    """Averaged over members and sizes, over the base model's."""
    log_prior: float
    prices: tuple[float, ...] = ()
    """Log of the price paid for searching each error's member and size, where the set is settled."""
    key: Key = field(init=False)
    """Its families, sorted."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "key", tuple(sorted(c.family for c in self.choices)))

    @property
    def log_posterior(self) -> float:
        """Up to a constant that all share."""
        return self.log_evidence + self.log_prior


class Search:
    """All sets found in one frame."""

    def __init__(self, bank: Bank) -> None:
        self.bank = bank
        self.families = bank.families
        weight = np.array([f.weight for f in bank.families])
        self._log_weight: Real = np.log(weight / weight.sum())
        self.found: dict[Key, Candidate] = {(): Candidate((), 0.0, float(np.log(BY_COUNT[0])))}
        self._searched = [k for k, f in enumerate(bank.families) if f.neighbours is not None]
        self._looked: set[frozenset[Choice]] = set()
        """Sets at these members and sizes: the missing errors beside them depend on those."""
        self._polished_keys: set[Key] = set()

    def first(self) -> Candidate:
        """The most probable of no error and one."""
        self._look(Candidate((), 0.0, 0.0))
        return max(self.found.values(), key=lambda c: c.log_posterior)

    def run(self, seeds: Sequence[tuple[Choice, ...]] = ()) -> list[Candidate]:
        """Most probable first; `seeds` are further sets to search beside."""
        self.first()
        singles = self._best(1, FIRST)
        alone = bool(singles) and self._leaves_noise(singles[0])
        worth = bool(singles) and singles[0].log_posterior > self.found[()].log_posterior + np.log(0.02)
        if worth and singles[0].log_evidence > NOTHING_FOUND:
            for k, single in enumerate(singles):
                if k == 0 or not alone or single.log_posterior > singles[0].log_posterior - ALONE_WITHIN:
                    self._look(single)
            if not alone or not self.families[singles[0].key[0]].named:
                self._look_for_two_waves()
            for seed in seeds:
                self._look(self._polished(Candidate(seed, 0.0, 0.0)))
            pairs = self._best(2, SECOND)
            if not alone or (pairs and pairs[0].log_posterior > singles[0].log_posterior - NEARLY):
                for pair in pairs:
                    self._look(self._settled(pair))
            self._exchange()
        self._polish()
        return sorted(self.found.values(), key=lambda c: -c.log_posterior)

    def _leaves_noise(self, single: Candidate) -> bool:
        """Whether one error leaves no more than noise, so that only its alternatives need a second error."""
        bank = self.bank
        return bank.noise.level(bank.square - 2.0 * bank.known(single.choices).gain) < NOISY

    def _best(self, count: int, most: int) -> list[Candidate]:
        sets = sorted(
            (c for c in self.found.values() if len(c.choices) == count), key=lambda c: -c.log_posterior
        )
        if not sets:
            return []
        top = max(c.log_posterior for c in self.found.values())
        # a set far below the best may still be half of the best pair
        limit = min(top, sets[0].log_posterior) - (WITHIN if count > 1 else np.inf)
        return [c for c in sets[:most] if c.log_posterior > limit]

    def log_prior(self, key: Key) -> float:
        """Log prior of a set of families in any order."""
        count = len(key)
        orders = float(np.log([1.0, 1.0, 2.0, 6.0][count]))
        return float(np.log(BY_COUNT[count]) + orders + sum(self._log_weight[k] for k in key))

    def _look(self, beside: Candidate) -> None:
        """Evaluate every family beside a set."""
        key, at = beside.key, frozenset(beside.choices)
        if at in self._looked or len(key) >= len(BY_COUNT) - 1:
            return
        self._looked.add(at)
        known = self.bank.known(beside.choices)
        price = beside.log_evidence - self.bank.log_evidence(known)
        scan = self._refined(self.bank.scan(known), known, key, price)
        for family in range(len(self.families)):
            if self._fits(key, family):
                self._add(beside.choices, scan, family, price)

    def _refined(self, scan: Scan, known: Known, beside: Key, price: float) -> Scan:
        """The promising ones of a scan at the best values of their continuous hidden parameters."""
        top = float(scan.total.max())
        if top < NOTHING_FOUND:
            return scan
        best, total, at_best = list(scan.best), scan.total.copy(), scan.at_best.copy()
        weighed = scan.total + price + self._log_weight
        limit = weighed.max() - REFINED_WITHIN
        if beside:
            found = max(c.log_posterior for c in self.found.values())
            limit = max(limit, found - self.log_prior(beside) - REFINED_WITHIN)
        searched = [k for k in self._searched if scan.best[k] is not None]
        searched.sort(key=lambda k: -weighed[k])
        strong = STRONG + self.bank.log_evidence(known) + price
        for rank, family in enumerate(searched):
            # with nothing else found, a wave between two steps of the search may be far better than shown
            free = (not beside and rank < REFINED) or (
                len(beside) == 1 and rank == 0 and scan.total[family] + price > strong
            )
            if not free and weighed[family] < limit:
                break
            choice = scan.best[family]
            assert choice is not None
            self.bank.refine(choice, known)
            again = self.bank.scan(known, only=family)
            best[family] = again.best[family]
            total[family], at_best[family] = again.total[family], again.at_best[family]
        return Scan(total, tuple(best), at_best)

    def _add(self, beside: tuple[Choice, ...], scan: Scan, family: int, price: float) -> None:
        choice = scan.best[family]
        if choice is None:
            return
        value = float(scan.total[family]) + price
        choices = (*beside, choice)
        key = tuple(sorted(c.family for c in choices))
        before = self.found.get(key)
        if before is None or value > before.log_evidence:
            self.found[key] = Candidate(choices, value, self.log_prior(key))
            self._polished_keys.discard(key)

    def _fits(self, key: Key, family: int) -> bool:
        """Whether a family may be added: the same effect twice only if the machine can have it twice."""
        added = self.families[family]
        if family in key:
            return added.repeats
        return not any(compete(self.families[k], added) for k in key)

    def _look_for_two_waves(self) -> None:
        """Two waves of one joint hide each other's frequency: every one is tried beside every other."""
        for family, known in enumerate(self.families):
            if not known.repeats or known.neighbours is None or known.parts[0].joint is None:
                continue
            pairs: dict[frozenset[int], tuple[float, tuple[Choice, ...]]] = {}
            for one in self.bank.singles(family):
                other = self.bank.scan(self.bank.known((one,)), only=family).best[family]
                assert other is not None
                # the size of the first was the best without the second
                one = self.bank.scan(self.bank.known((other,)), only=family).best[family] or one
                value = self.bank.log_evidence(self.bank.known((one, other)))
                pairs[frozenset((one.member, other.member))] = value, (one, other)
            for value, choices in sorted(pairs.values(), reverse=True)[:PAIRS]:
                if value < PROMISING * self._best(1, 1)[0].log_evidence:
                    break
                pair = Candidate(choices, 0.0, self.log_prior((family, family)))
                found = self._polished(pair, SWEEPS_OF_WAVES)
                before = self.found.get(found.key)
                if before is None or found.log_evidence > before.log_evidence:
                    self.found[found.key] = found

    def _exchange(self) -> None:
        for _ in range(EXCHANGES):
            best = max(self.found.values(), key=lambda c: c.log_posterior)
            looked = len(self._looked)
            best = self._settled(best)
            for left_out in range(len(best.prices)):
                self._look(self._without(best, left_out))
            self._look(best)
            if len(self._looked) == looked:
                return

    def _without(self, settled: Candidate, left_out: int) -> Candidate:
        """The other errors unchanged, without the omitted one."""
        kept = [k for k in range(len(settled.choices)) if k != left_out]
        choices = tuple(settled.choices[k] for k in kept)
        prices = tuple(settled.prices[k] for k in kept)
        value = self.bank.log_evidence(self.bank.known(choices)) + sum(prices)
        return Candidate(choices, value, self.log_prior(tuple(c.family for c in choices)), prices)

    def _polish(self) -> None:
        """Settle the best sets."""
        best = sorted(self.found.values(), key=lambda c: -c.log_posterior)[: 2 * MOST_POLISHED]
        for _ in range(MOST_POLISHED):
            best.sort(key=lambda c: -c.log_posterior)
            limit = best[0].log_posterior - POLISHED_WITHIN
            for k, c in enumerate(best):
                if len(c.choices) > 1 and c.key not in self._polished_keys and c.log_posterior > limit:
                    best[k] = self._settled(c)
                    break
            else:
                return

    def _settled(self, candidate: Candidate) -> Candidate:
        """Members and sizes of a set, each given the others, and their prices."""
        if len(candidate.choices) < 2 or candidate.key in self._polished_keys:
            return self.found[candidate.key]
        self._polished_keys.add(candidate.key)
        self.found[candidate.key] = self._polished(candidate)
        return self.found[candidate.key]

    def _polished(self, candidate: Candidate, sweeps: int = SWEEPS) -> Candidate:
        choices = list(candidate.choices)
        value, prices = -np.inf, [0.0] * len(choices)
        for _ in range(sweeps):
            moved = False
            for k, old in enumerate(choices):
                others = [c for j, c in enumerate(choices) if j != k]
                known = self.bank.known(others)
                scan = self.bank.scan(known, only=old.family)
                new = scan.best[old.family]
                if new is None:
                    continue
                moved |= new != old
                if self.families[old.family].neighbours is not None:
                    self.bank.refine(new, known)
                    scan = self.bank.scan(known, only=old.family)
                    new = scan.best[old.family] or new
                choices[k] = new
                prices[k] = float(scan.total[old.family] - scan.at_best[old.family])
            before, value = value, self.bank.log_evidence(self.bank.known(choices))
            if not moved and value < before + SETTLED:
                break
        return replace(
            candidate, choices=tuple(choices), log_evidence=value + sum(prices), prices=tuple(prices)
        )


def compete(a: Family, b: Family) -> bool:
    """Whether two families contain the same effect and therefore exclude each other."""
    return a is not b and a.named and b.named and bool(a.keys & b.keys)
