"""A diagnosis as one self-contained HTML page, in the reader's language."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from station.diagnosis.report.findings import Findings, FoundEffect
from station.diagnosis.report.joint_curves import Curve
from station.diagnosis.report.report_charts import MICROMETRES, curve_chart, residual_charts
from station.diagnosis.report.wording import Wording, figures
from station.messages import Language, report_text
from station.records import Quantity, guesses_in_words, reason_in
from station.report import Chart, Page, Section, Table


def page(findings: Findings, source: str, language: Language = "en") -> Page:
    """Verdict, stages, causes, residual before and after, detection limits.

    :param source: the source of the readings, in the same language
    """
    wording = Wording(language)
    sections = [_errors(findings, wording)]
    if findings.effects:
        sections.append(_causes(findings, wording))
    if findings.explanations:
        sections.append(_probabilities(findings, wording))
    if findings.curves:
        sections.append(_curves(findings.curves, wording))
    if findings.hints:
        sections.append(_hints(findings, wording))
    sections += [
        _residual(findings, wording),
        _parameters(findings, wording),
        _invisible(findings, wording),
    ]
    reason = findings.reason
    return Page(
        wording.say("title", source=source),
        reason_in(reason.code, reason.params, language),
        sections,
        wording.of_charts,
    )


def run_source(run: int, uid: str, robot: str, language: Language) -> str:
    """A run of this station as written in the title of its report."""
    return report_text("run", language, run=run, uid=uid, robot=robot)


def shown(q: Quantity) -> str:
    """Value +- sd with two digits of the sd."""
    return f"{figures(q)} {q.unit}"


def _errors(findings: Findings, w: Wording) -> Section:
    rows = []
    for s in findings.stages:
        sizes = (s.fit_rms_mm, s.holdout_rms_mm, s.holdout_max_mm, s.confirm_rms_mm, s.confirm_max_mm)
        rows.append((w.stage(s.model), s.unknowns, *(_um(v, w) for v in sizes)))
    noise, measurements = findings.noise, findings.measurements
    noise_um = noise.sigma_mm * MICROMETRES
    text = (
        w.say("noise_repeats", noise_um=noise_um, dof=noise.dof)
        if noise.source == "repeats"
        else w.say("noise_specified", noise_um=noise_um)
    )
    heads = ("model", "unknowns", "fit_rms", "left_out_rms", "largest", "fresh_rms", "largest")
    return Section(
        w.say("errors"),
        (text, *([guesses_in_words(measurements, w.language)] if measurements.guessed else [])),
        (Table(_heads(w, *heads), rows, w.say("errors_caption")), *_position_errors(findings, w)),
    )


def _heads(w: Wording, *keys: str) -> tuple[str, ...]:
    return tuple(map(w.say, keys))


def _position_errors(findings: Findings, w: Wording) -> Iterator[Table]:
    for by, errors, caption in (
        ("commands_by", findings.position_errors, f"predicted_{findings.extent.replace(' ', '_')}"),
        ("position_by", findings.true_position_errors, "true_error"),
    ):
        if errors is not None:
            named = zip(_heads(w, "base_model", "last_model"), errors, strict=True)
            rows = [(name, w.number(f"{e.rms:.3f}"), w.number(f"{e.max:.3f}")) for name, e in named]
            yield Table(_heads(w, by, "rms", "largest"), rows, w.say(caption))


def _um(value: float | None, w: Wording) -> str:
    return "" if value is None else w.number(f"{value * MICROMETRES:.2f}")


def _causes(findings: Findings, w: Wording) -> Section:
    rows = [
        (
            w.labels([found.label]),
            "; ".join(f"{w.parameter(q.name)} {w.quantity(q)}" for q in found.parameters),
            w.number(f"{100.0 * found.share:.1f} %"),
            w.number(f"{found.p_value:.1g}" if found.probability is None else _percent(found.probability)),
            w.listed(found.alias_labels) or w.say("nothing"),
        )
        for found in findings.effects
    ]
    certainty = "p_value" if findings.effects[0].probability is None else "probability"
    heads = _heads(w, "effect", "size", "share_of_square", certainty, "looks_the_same")
    return Section(
        w.say("effects_tried" if findings.decision.refuted else "effects_added"),
        _explanations(findings.effects, w),
        (Table(heads, rows),),
    )


def _percent(share: float) -> str:
    return f"{100.0 * share:.0f} %"


def _probabilities(findings: Findings, w: Wording) -> Section:
    """The set of explanations, and the experiments that would decide between them."""
    rows = [
        (
            w.labels([effect.label for effect in one.effects]) if one.effects else w.say("no_effect"),
            _percent(one.probability),
        )
        for one in findings.explanations
    ]
    tables = [Table(_heads(w, "explanation", "probability"), rows)]
    if findings.experiments:
        tables.append(
            Table(
                _heads(w, "experiment", "decides"),
                [(w.sentence(one.said, one.text), _percent(one.decides)) for one in findings.experiments],
            )
        )
    text = [w.say("explanations_text")]
    mistake = findings.mistake
    if mistake is not None:
        text.insert(0, w.sentence(mistake.said, mistake.text))
    return Section(w.say("explanations"), text, tuple(tables))


def _curves(drawn: Sequence[Curve], w: Wording) -> Section:
    """Each joint's curve with twice its sd, and the readings' means of it."""
    charts = tuple(Chart(curve_chart(curve, w), w.labels([curve.label])) for curve in drawn)
    return Section(w.say("curves"), (w.say("curves_text"),), (), charts)


def _explanations(effects: Sequence[FoundEffect], w: Wording) -> list[str]:
    """Physics and remedy, once for all effects that share them."""
    by_text: dict[str, list[str]] = {}
    for found in effects:
        text = w.sentence(found.physics)
        if found.remedy is not None:
            text = w.say("remedy", physics=text, remedy=w.sentence(found.remedy))
        if found.aliases:
            text = w.say("to_distinguish", text=text, experiment=w.sentence(found.experiment))
        by_text.setdefault(text, []).append(found.label)
    return [w.say("effects_are", labels=w.listed(labels), text=text) for text, labels in by_text.items()]


def _hints(findings: Findings, w: Wording) -> Section:
    rows = [(w.depends_on(h.depends_on), _percent(h.strength), w.sentence(h.said)) for h in findings.hints]
    return Section(
        w.say("hints"),
        (w.say("hints_text"),),
        (Table(_heads(w, "depends_on_head", "share", "in_words"), rows),),
    )


def _residual(findings: Findings, w: Wording) -> Section:
    added = bool(findings.added)
    text = w.say("residual_effects" if added else "residual_base")
    charts = residual_charts(findings.measurements, findings.residual, added, w)
    return Section(w.say("residual"), (text,), (), tuple(charts))


def _parameters(findings: Findings, w: Wording) -> Section:
    weak, stage = findings.weak_direction, findings.origin
    origin = w.say("origin_mean") if stage is None else w.say("origin_stage", stage=w.stage(stage))
    blind = "; ".join(map(w.sentence, weak.blind_said))
    direction = w.sentence(weak.said, weak.text)
    text = [w.say("weak", origin=origin, weak=direction, sd_deg=weak.sd_deg or 0.0, blind=blind)]
    if findings.decision.sd_factor > 1.0:
        text.append(w.say("widened", factor=findings.decision.sd_factor))
    text += [w.say("outlier", reading=o.reading, why=w.sentence(o.said)) for o in findings.outliers]
    if findings.fresh_outliers:
        text.append(w.say("fresh_outliers", readings=", ".join(map(str, findings.fresh_outliers))))
    rows = [
        (w.parameter(q.name), w.number(f"{q.value:.5f}"), w.number(f"{q.sd:.5f}"), w.unit(q.unit))
        for q in findings.parameters
    ]
    remedies = [(w.sentence(r.said, r.text), w.number(f"{r.sd_deg:.4f}")) for r in weak.remedies]
    return Section(
        w.say("parameters"),
        text,
        (
            Table(_heads(w, "parameter", "value", "sd", "unit"), rows),
            Table(_heads(w, "would_hold", "sd_deg"), remedies),
        ),
    )


def _invisible(findings: Findings, w: Wording) -> Section:
    rows = [
        (
            w.labels([i.label]),
            w.parameter(i.parameter) if i.parameter else "",
            ""
            if i.minimum_detectable is None
            else w.number(f"{i.minimum_detectable:.3g} ") + w.unit(i.unit or ""),
            w.sentence(i.said, i.text),
        )
        for i in findings.invisible
    ]
    heads = _heads(w, "effect", "parameter", "smallest", "remark")
    return Section(w.say("invisible"), (w.say("invisible_text"),), (Table(heads, rows),))
