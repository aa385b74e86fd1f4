"""A diagnosis as one self-contained HTML page."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
from markupsafe import Markup

from station.diagnosis.report.findings import Findings, FoundEffect, ResidualView
from station.diagnosis.report.joint_curves import Curve
from station.records import Measurements, Quantity, Real, guesses_in_words
from station.report import Chart, Page, Section, Series, Table, line, place_map, scatter

UM = "µm"
MICROMETRES = 1e3
MOST_POINTS = 600
MOST_PLACES = 300
GAP_DEG = 1.0


def page(findings: Findings, source: str) -> Page:
    """Verdict, stages, causes, residual before and after, what could not have been seen."""
    sections = [_errors(findings)]
    if findings.effects:
        sections.append(_causes(findings))
    if findings.explanations:
        sections.append(_probabilities(findings))
    if findings.curves:
        sections.append(_curves(findings.curves))
    if findings.hints:
        sections.append(_hints(findings))
    sections += [_residual(findings), _parameters(findings), _invisible(findings)]
    return Page(f"Diagnosis of {source}", findings.sentence, sections)


def shown(q: Quantity) -> str:
    """Value +- sd with two digits of the sd."""
    if not q.sd:
        return f"{q.value:.6g} {q.unit}"
    digits = max(0, 1 - int(np.floor(np.log10(q.sd))))
    return f"{q.value:.{digits}f} ± {q.sd:.{digits}f} {q.unit}"


def _errors(findings: Findings) -> Section:
    rows = []
    for s in findings.stages:
        sizes = (s.fit_rms_mm, s.holdout_rms_mm, s.holdout_max_mm, s.confirm_rms_mm, s.confirm_max_mm)
        rows.append((s.model, s.unknowns, *(_um(v) for v in sizes)))
    noise, measurements = findings.noise, findings.measurements
    origin = f"from {noise.dof} repeats" if noise.source == "repeats" else "as specified"
    return Section(
        "Errors before and after",
        (
            f"Noise of one reading {noise.sigma_mm * MICROMETRES:.2f} {UM}, {origin}. "
            "“Place left out”: each place predicted from all others. "
            "“Fresh”: readings taken afterwards, predicted with everything frozen.",
            *([guesses_in_words(measurements)] if measurements.guessed else []),
        ),
        (
            Table(
                ("model", "unknowns", "fit rms", "place left out rms", "largest", "fresh rms", "largest"),
                rows,
                f"Measured less predicted, {UM}",
            ),
            *_position_errors(findings),
        ),
    )


def _position_errors(findings: Findings) -> Iterator[Table]:
    predicted = f"Predicted position error over {findings.extent}, mm"
    for by, errors, caption in (
        ("commands by", findings.position_errors, predicted),
        ("position by", findings.true_position_errors, "True position error, against the tracker, mm"),
    ):
        if errors is not None:
            named = zip(("base model", "last model"), errors, strict=True)
            rows = [(name, f"{e.rms:.3f}", f"{e.max:.3f}") for name, e in named]
            yield Table((by, "rms", "largest"), rows, caption)


def _um(value: float | None) -> str:
    return "" if value is None else f"{value * MICROMETRES:.2f}"


def _causes(findings: Findings) -> Section:
    rows = [
        (
            found.label,
            "; ".join(f"{q.name} {shown(q)}" for q in found.parameters),
            f"{100.0 * found.share:.1f} %",
            f"{found.p_value:.1g}" if found.probability is None else f"{100.0 * found.probability:.0f} %",
            ", ".join(found.alias_labels) or "nothing",
        )
        for found in findings.effects
    ]
    certainty = "p" if findings.effects[0].probability is None else "probability"
    return Section(
        "Effects tried" if findings.decision.refuted else "Effects added",
        _explanations(findings.effects),
        (
            Table(
                (
                    "effect",
                    "size",
                    "share of the residual's square",
                    certainty,
                    "looks the same in these readings",
                ),
                rows,
            ),
        ),
    )


def _probabilities(findings: Findings) -> Section:
    """The set of explanations, and what would decide between them."""
    rows = [
        (
            " and ".join(effect.label for effect in one.effects) or "no effect",
            f"{100.0 * one.probability:.0f} %",
        )
        for one in findings.explanations
    ]
    tables = [Table(("explanation", "probability"), rows)]
    if findings.experiments:
        tables.append(
            Table(
                ("experiment", "probability that it decides"),
                [(one.text, f"{100.0 * one.decides:.0f} %") for one in findings.experiments],
            )
        )
    text = ["Every explanation of these readings with a probability of 1 % or more."]
    if findings.mistake is not None:
        text.insert(0, findings.mistake.text)
    return Section("Explanations", text, tuple(tables))


def _curves(drawn: Sequence[Curve]) -> Section:
    """Each joint's curve with twice its sd, and what the readings say of it."""
    return Section(
        "Curves learned",
        (
            "Error of the joint, in thousandths of a degree, over the angles it has been at; the band is "
            "twice the standard uncertainty. Points: means over two degrees of what the readings say of it "
            "when everything else in the model is right. Outside these angles the curve is not known.",
        ),
        (),
        tuple(Chart(curve_chart(curve), curve.label) for curve in drawn),
    )


def curve_chart(curve: Curve) -> Markup:
    """One joint's curve."""
    low, high = (curve.value_deg + sign * 2.0 * curve.sd_deg for sign in (-1.0, 1.0))
    gaps = np.flatnonzero(np.diff(curve.angle_deg) > GAP_DEG) + 1
    stretches = [
        _milli(*(values[part] for values in (curve.angle_deg, curve.value_deg, low, high)))
        for part in np.split(np.arange(len(curve.angle_deg)), gaps)
    ]
    measured = _milli(curve.binned_angle_deg, curve.binned_deg)
    return line(
        [
            replace(stretches[0], label="learned"),
            replace(measured, label="measured", points_only=True),
            *(replace(stretch, like=0) for stretch in stretches[1:]),
        ],
        f"theta{curve.joint} deg",
        "error 0.001 deg",
    )


def _milli(angle: Real, value: Real, low: Real | None = None, high: Real | None = None) -> Series:
    return Series(
        "",
        angle.tolist(),
        (1e3 * value).tolist(),
        None if low is None else (1e3 * low).tolist(),
        None if high is None else (1e3 * high).tolist(),
    )


def _explanations(effects: Sequence[FoundEffect]) -> list[str]:
    """Physics and remedy, once for all effects that share them."""
    by_text: dict[str, list[str]] = {}
    for found in effects:
        text = f"{found.physics} Remedy: {found.remedy}" if found.remedy else found.physics
        if found.aliases:
            text += f" To distinguish them: {found.experiment}"
        by_text.setdefault(text, []).append(found.label)
    return [f"{', '.join(labels)}: {text}" for text, labels in by_text.items()]


def _hints(findings: Findings) -> Section:
    return Section(
        "What the rest depends on",
        ("Found without the catalogue.",),
        (
            Table(
                ("depends on", "share", "in words"),
                [(h.depends_on, f"{100.0 * h.strength:.0f} %", h.text) for h in findings.hints],
            ),
        ),
    )


def _residual(findings: Findings) -> Section:
    added = bool(findings.added)
    text = ["Left: the base model's residual" + (", and what the effects account for. " if added else ". ")]
    if added:
        text[0] += "Right: what is left with the effects in the model."
    return Section("Residual", text, (), tuple(_charts(findings.measurements, findings.residual, added)))


def _by_joint(m: Measurements, view: ResidualView) -> Iterator[tuple[str, Real]]:
    for i in range(m.joints):
        if i + 1 in m.sliding:
            yield f"travel{i + 1} mm", view.theta[:, i] * 1e3
        else:
            yield f"theta{i + 1} deg", np.degrees(view.theta[:, i])


def _charts(m: Measurements, view: ResidualView, added: bool) -> Iterator[Chart]:
    """Pairs against order, time, angles, travel, approach and place; single ones where nothing was added."""
    was, left = view.before_mm * MICROMETRES, view.after_mm * MICROMETRES
    by_number: list[tuple[str, Real]] = [
        ("order", np.arange(1.0, len(was) + 1.0)),
        ("time s", m.t_s),
        *_by_joint(m, view),
    ]
    if np.ptp(view.travel_mm) > 0:
        by_number.append(("travel mm", view.travel_mm))
    if view.temperature_rise_k is not None:
        by_number.append(("temperature rise K", view.temperature_rise_k))
    for name, along in by_number:
        yield Chart(scatter(_series(along, was, left, added), name, f"residual {UM}"), f"before, by {name}")
        if added:
            yield Chart(scatter([_points("left", along, left)], name, f"rest {UM}"), f"after, by {name}")
    for i in range(m.joints):
        if np.any(view.approach[:, i]):
            yield from _by_approach(i, view.approach[:, i], was, left, added)
    at = view.place_mm
    first = np.unique(m.position, return_index=True)[1]
    for values, name in ((was, "before"), (left, "after")):
        mean = np.bincount(m.position, values) / np.maximum(np.bincount(m.position), 1)
        places = mean[m.position[first]]
        every = -(-len(first) // MOST_PLACES)
        x, y, value = (v[::every].tolist() for v in (at[first, 0], at[first, 1], places))
        drawing = place_map(x, y, value, UM)
        yield Chart(drawing, f"{name}, mean of each place")
        if not added:
            break


def _by_approach(i: int, approach: Real, was: Real, left: Real, added: bool) -> Iterator[Chart]:
    names = ("from above (-1)", "unknown (0)", "from below (+1)")
    # side by side, so that points of one kind do not cover each other
    along = approach + 1.0 + np.linspace(-0.3, 0.3, len(approach))
    label = f"approach of joint {i + 1}"
    yield Chart(
        scatter(_series(along, was, left, added), label, f"residual {UM}", x_names=names),
        f"before, by {label}",
    )
    if added:
        drawing = scatter([_points("left", along, left)], label, f"rest {UM}", x_names=names)
        yield Chart(drawing, f"after, by {label}")


def _series(along: Real, was: Real, left: Real, added: bool) -> Sequence[Series]:
    measured = _points("measured less base model", along, was)
    return (measured, _points("the effects account for", along, was - left)) if added else (measured,)


def _points(label: str, x: Real, y: Real) -> Series:
    """Of thousands of points only so many as can be told apart on the page, evenly spread over the log."""
    every = -(-len(x) // MOST_POINTS)
    return Series(label, x[::every].tolist(), y[::every].tolist())


def _parameters(findings: Findings) -> Section:
    weak = findings.weak_direction
    text = [
        f"{findings.origin} Determined least: "
        f"{weak.text}, standard uncertainty {weak.sd_deg or 0.0:.4f} deg. "
        f"Not seen by one distance at all: {'; '.join(weak.blind)}."
    ]
    if findings.decision.sd_factor > 1.0:
        text.append(
            f"The model does not fit: every sd is widened by {findings.decision.sd_factor:.1f}, "
            "the ratio of what is left to the noise."
        )
    text += [f"Left out: reading {o.reading}, {o.reason}." for o in findings.outliers]
    if findings.fresh_outliers:
        names = ", ".join(map(str, findings.fresh_outliers))
        text.append(f"Left out of the confirmation: fresh reading {names}.")
    rows = [(q.name, f"{q.value:.5f}", f"{q.sd:.5f}", q.unit) for q in findings.parameters]
    remedies = [(r.text, f"{r.sd_deg:.4f}") for r in weak.remedies]
    return Section(
        "Parameters",
        text,
        (
            Table(("parameter", "value", "sd", "unit"), rows),
            Table(("what would hold the weak direction", "sd deg"), remedies),
        ),
    )


def _invisible(findings: Findings) -> Section:
    rows = [
        (
            i.label,
            i.parameter or "",
            "" if i.minimum_detectable is None else f"{i.minimum_detectable:.3g} {i.unit}",
            i.text,
        )
        for i in findings.invisible
    ]
    return Section(
        "What these readings could not have shown",
        ("Smaller effects may be present. An effect of the size shown is detected with 80 % probability.",),
        (Table(("effect", "parameter", "smallest visible size", "remark"), rows),),
    )
