"""The text of a certificate's page, line by line, in the reader's language.

HTML and PDF print the same lines; each names the field of `CertificateFacts` that it states.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from station.certificate.budget import Contribution
from station.certificate.facts import CertificateFacts, ExpandedQuantity
from station.messages import (
    Language,
    certificate_text,
    display_name,
    effect_name,
    local_date,
    local_number,
    local_time,
    measured,
    parameter_name,
    reasons,
)
from station.records import reason_in

MOST_EFFECTS = 4
"""Maximum number on one page; the record has all."""


@dataclass(frozen=True, slots=True)
class Line:
    """A label and its text."""

    field: str
    label: str
    text: str


@dataclass(frozen=True, slots=True)
class Block:
    """Lines that belong together."""

    title: str
    lines: tuple[Line, ...]


@dataclass(frozen=True, slots=True)
class Sheet:
    """One page."""

    language: Language
    title: str
    statement: Line
    good: bool
    """Whether the statement permits use of the robot as it is."""
    emulated: str
    """Note that no real machine was measured; empty for a real one."""
    blocks: tuple[Block, ...]
    notes: tuple[str, ...]
    """Uncertainty, method, and how to check the certificate."""
    signed_by: str
    map_titles: tuple[str, str, str]
    map_scale: str

    @property
    def lines(self) -> tuple[Line, ...]:
        """All printed lines."""
        return (self.statement, *(line for block in self.blocks for line in block.lines))


def sheet_of(facts: CertificateFacts, language: Language) -> Sheet:
    """The page of a certificate."""
    writer = _Writer(facts, language)
    good = facts.statement.verdict == "pass"
    return Sheet(
        language=language,
        title=writer.say("title_good" if good else "title_not_good"),
        statement=writer.statement(),
        good=good,
        emulated=writer.say("emulated") if facts.made_by and facts.made_by.emulated else "",
        blocks=tuple(
            Block(writer.say(title), lines)
            for title, lines in (
                ("block_object", tuple(writer.object())),
                ("block_results", tuple(writer.results())),
                ("block_effects", tuple(writer.effects())),
                ("block_traceability", tuple(writer.traceability())),
                ("block_budget", tuple(writer.budget())),
                ("block_record", tuple(writer.record())),
            )
            if lines
        ),
        notes=(
            writer.say("note_uncertainty", k=local_number(facts.coverage_factor, 0, language)),
            writer.say("note_check"),
        ),
        signed_by=writer.say("signature"),
        map_titles=(writer.say("map_before"), writer.say("map_after"), writer.say("map_bound")),
        map_scale=writer.say("map_scale"),
    )


@dataclass(frozen=True, slots=True)
class _Writer:
    facts: CertificateFacts
    language: Language

    def say(self, key: str, **values: str) -> str:
        return certificate_text(key, self.language).format_map(values)

    def line(self, field: str, label: str, text: str, **values: str) -> Line:
        return Line(field, self.say(label, **values), text)

    def mm(self, value: float | None) -> str:
        return self.say("none") if value is None else f"{local_number(value, 3, self.language)} mm"

    def statement(self) -> Line:
        error, statement = self.facts.position_error, self.facts.statement
        outcome = display_name("outcomes", statement.outcome or "failed", self.language)
        if statement.verdict == "pass" and error.bound_95_mm is not None:
            key = "good_within" if error.wanted_mm is not None else "good_without_limit"
            said = self.say(key, bound=self.mm(error.bound_95_mm), wanted=self.mm(error.wanted_mm))
        else:
            said = self.reason()
        return Line("statement", outcome, said)

    def reason(self) -> str:
        statement = self.facts.statement
        if statement.reason_code is None or statement.reason_code not in reasons(self.language):
            return statement.reason or ""
        return reason_in(statement.reason_code, statement.reason_params, self.language)

    def object(self) -> Iterator[Line]:
        facts = self.facts
        yield self.line("robot_serial", "robot", f"{facts.robot_serial} ({self.say('five_bar')})")
        made = facts.made_by
        if made is not None:
            yield self.line("made_by.station", "station", f"{made.station}; fivebar-station {made.software}")
        plan = facts.plan
        try:
            plan = display_name("plans", facts.plan, self.language)
        except KeyError:
            plan = display_name("run_kinds", facts.kind, self.language)
        yield self.line("plan", "plan", f"{plan}, {self.say('readings', count=str(facts.readings))}")
        if facts.ended_at is not None:
            yield self.line("ended_at", "measured", local_time(facts.ended_at, self.language))
        yield self.line("operator", "operator", facts.operator)
        if facts.work_order:
            yield self.line("work_order", "work_order", facts.work_order)

    def results(self) -> Iterator[Line]:
        facts, error = self.facts, self.facts.position_error
        for index, zero in enumerate(facts.zero_offsets):
            joint = zero.name.removeprefix("joint")
            yield self.line(f"zero_offsets[{index}]", "zero_offset", self.quantity(zero), joint=joint)
        if (drives := facts.zeros_in_drives) is not None:
            text = self.say(f"drives_{drives.state.replace(' ', '_')}")
            if drives.verified:
                text = f"{text}, {self.say('verified', run=str(drives.run))}"
            yield self.line("zeros_in_drives", "drives", text)
        yield self.line("position_error.before_max_mm", "before", self.mm(error.before_max_mm))
        yield self.line("position_error.bound_95_mm", "after", self.mm(error.bound_95_mm))
        wanted = self.say("no_limit") if error.wanted_mm is None else self.mm(error.wanted_mm)
        yield self.line("position_error.wanted_mm", "limit", wanted)
        if error.fresh_reading_rms_mm is not None:
            text = self.say(
                "fresh_values",
                rms=self.um(1000 * error.fresh_reading_rms_mm),
                max=self.um(1000 * (error.fresh_reading_max_mm or 0.0)),
            )
            yield self.line("position_error.fresh_reading_rms_mm", "fresh", text)
        if facts.method:
            try:
                method = self.say(f"method_{facts.method.replace(' ', '_')}")
            except KeyError:
                method = facts.method
            yield self.line("method", "method", method)
        for index, use in enumerate(facts.references):
            yield self.line(f"references[{index}]", "reference", use.reference.words)

    def effects(self) -> Iterator[Line]:
        found = self.facts.effects
        for index, effect in enumerate(found[:MOST_EFFECTS]):
            sizes = "; ".join(
                f"{parameter_name(q.name, self.language)} {self.quantity(q)}" for q in effect.parameters[:2]
            )
            yield Line(f"effects[{index}]", effect_name(effect.label, self.language), sizes)
        if len(found) > MOST_EFFECTS:
            more = self.say("more_effects", count=str(len(found) - MOST_EFFECTS))
            yield self.line(f"effects[{MOST_EFFECTS}]", "further", more)

    def traceability(self) -> Iterator[Line]:
        made = self.facts.made_by
        if made is None:
            yield self.line("made_by", "devices", self.say("not_recorded"))
            return
        for index, device in enumerate(made.devices):
            yield Line(
                f"made_by.devices[{index}]", self.device(device.name), f"{device.driver}, {device.address}"
            )
        scale = made.scale_certificate
        if scale is None:
            yield self.line("made_by.scale_certificate", "scale", self.say("not_traced"))
            return
        at = "made_by.scale_certificate"
        yield self.line(f"{at}.scale", "scale", scale.scale)
        yield self.line(f"{at}.certificate", "scale_certificate", f"{scale.certificate}, {scale.laboratory}")
        text = self.say(
            "covers",
            calibrated=local_date(scale.calibrated, self.language),
            due=local_date(scale.due, self.language),
        )
        yield self.line(f"{at}.due", "scale_dates", text)
        constant = local_number(scale.u95_um, 2, self.language)
        slope = local_number(scale.u95_um_per_m, 2, self.language)
        yield self.line(f"{at}.u95_um", "scale_u95", f"{constant} µm + {slope} µm/m · L (k = 2)")

    def device(self, name: str) -> str:
        if name.startswith("servo axis "):
            return self.say("servo_axis", number=name.removeprefix("servo axis "))
        return self.say("linear_scale") if name == "linear scale" else name

    def budget(self) -> Iterator[Line]:
        lines = self.facts.reading_budget
        for index, one in enumerate(lines):
            yield Line(f"reading_budget[{index}]", self.source(one), self.um(one.standard_um))

    def source(self, one: Contribution) -> str:
        values = {
            key: local_number(value, 0 if value == round(value) else 2, self.language)
            for key, value in one.detail.items()
        }
        kind = self.say("evaluation", type=one.evaluation, distribution=self.say(one.distribution))
        return f"{self.say(f'budget_{one.source}', **values)} ({kind})"

    def record(self) -> Iterator[Line]:
        facts = self.facts
        yield self.line("number", "number", facts.number)
        yield self.line("issued_at", "issued", local_time(facts.issued_at, self.language))
        yield self.line("run", "run", str(facts.run))
        link = self.say("not_chained") if facts.record is None else facts.record.hash
        yield self.line("record.hash", "hash", link)

    def quantity(self, quantity: ExpandedQuantity) -> str:
        return measured(quantity.value, quantity.u95, quantity.unit, self.language)

    def um(self, value: float) -> str:
        digits = 1 if value >= 10 else 2 if value >= 0.1 else 3
        return f"{local_number(value, digits, self.language)} µm"
