"""The texts of the report in a language: its own words, and the English names and sentences of the diagnosis.

In English, effects and parameters have the same names as in documents and at the terminal.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from station.messages import (
    Language,
    capital,
    dependence_name,
    labels_in_words,
    number_in_words,
    parameter_name,
    report_text,
    unit_name,
)
from station.records import Phrase, Quantity
from station.report import Words

NAMED_STAGES = ("paper", "nominal", "base")
ADDED = "+ "


@dataclass(frozen=True)
class Wording:
    """The texts in one language."""

    language: Language

    def say(self, key: str, **values: float | int | str) -> str:
        """A text of the report."""
        return report_text(key, self.language, **values)

    def sentence(self, said: Phrase | None, english: str = "") -> str:
        """A sentence of the diagnosis, or its English form where its code is unknown."""
        return said.text(self.language) if said else english

    def number(self, text: str) -> str:
        """A number that is already formatted."""
        return number_in_words(text, self.language)

    def labels(self, labels: Sequence[str]) -> str:
        """Effects with "and" between them, for a cell or the start of a sentence."""
        return capital(labels_in_words(" and ".join(labels), self.language))

    def listed(self, labels: Sequence[str]) -> str:
        """Effects, as a list for a cell or the start of a sentence."""
        return capital(self.say("between").join(labels_in_words(label, self.language) for label in labels))

    def parameter(self, name: str) -> str:
        """The name of a parameter; also of a further mount, `rMx@2`."""
        if self.language == "en":
            return name
        bare, _, mount = name.partition("@")
        shown = parameter_name(bare, self.language)
        return self.say("mounted", name=shown, mount=mount) if mount else shown

    def depends_on(self, name: str) -> str:
        """The quantity that a residual depends on."""
        return name if self.language == "en" else dependence_name(name, self.language)

    def stage(self, model: str) -> str:
        """A model in the sequence from the simplest one."""
        return stage_name(model, self.language)

    def unit(self, unit: str) -> str:
        """The unit in its usual form."""
        return unit if self.language == "en" else unit_name(unit)

    def quantity(self, q: Quantity) -> str:
        """Value ± sd with its unit."""
        return f"{self.number(figures(q))} {self.unit(q.unit)}".rstrip()

    @property
    def of_charts(self) -> Words:
        """The texts of a chart and of the page around it."""
        texts = {key: self.say(key, y="{y}", x="{x}", size="{size}") for key in OF_CHARTS}
        return Words(self.language, self.number("."), **texts)


OF_CHARTS = ("contents", "against", "negative", "positive")


def stage_name(model: str, language: Language) -> str:
    """One of three models by name, or one with one more effect."""
    if model in NAMED_STAGES:
        return report_text(f"stage_{model}", language)
    return ADDED + labels_in_words(model.removeprefix(ADDED), language)


def figures(q: Quantity) -> str:
    """Value ± sd with two digits of the sd."""
    if not q.sd:
        return f"{q.value:.6g}"
    digits = max(0, 1 - int(np.floor(np.log10(q.sd))))
    return f"{q.value:.{digits}f} ± {q.sd:.{digits}f}"


ENGLISH = Wording("en")
