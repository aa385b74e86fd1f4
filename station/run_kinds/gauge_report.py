"""The report of a gauge study of a station."""

from __future__ import annotations

from station.report import Chart, Page, Section, Series, Table, bar, scatter
from station.run_kinds.gauge_evaluation import JointStudied, StationGauge

GOOD, BAD = 10.0, 30.0
"""Percent of the total variation below which a gauge is good, and above which it is not acceptable (AIAG)."""
_COMPONENTS = {
    "repeat": "calibrations with one mounting",
    "mounting": "mountings of one operator",
    "ev": "repeatability (EV): both of these",
    "av": "reproducibility (AV): operators",
    "grr": "gauge (GRR): EV and AV",
    "pv": "robots (PV)",
    "tv": "total (TV)",
}
_SOURCES = {
    "readout": "readout: scatter of the samples of a reading",
    "drives": "drives: scatter of readings alike, beyond the readout's",
    "solver": "solver: the same readings from other starts",
    "unexplained": "not explained by these, with one mounting",
    "mounting": "mounting",
    "operators": "operators",
}


def gauge_page(study: StationGauge) -> Page:
    """The report with every value that it is based on."""
    design = study.design
    runs = ", ".join(map(str, study.runs))
    return Page(
        title="Gauge study",
        lead=(
            f"{len(study.robots)} {'robot' if len(study.robots) == 1 else 'robots'}"
            f" ({', '.join(study.robots)}), {design.operators} operators with {design.mountings} mountings"
            f" each, {design.repeats} calibrations with each mounting. Runs: {runs}. What is studied is the"
            " zero offset that a calibration by plan full states, without what earlier runs know."
        ),
        sections=(
            _decision(study),
            *(_joint(joint) for joint in study.joints),
            _values(study),
        ),
    )


def judgement(joint: JointStudied) -> str:
    """The assessment in one sentence."""
    percent = joint.grr_percent
    word = "good" if percent < GOOD else "not fit for the purpose" if percent > BAD else "of limited use"
    of = "the total variation" if joint.against == "robots" else "the tolerance"
    return (
        f"Joint {joint.joint}: the gauge takes {percent:.1f} % of {of}"
        f" ({joint.intervals['grr_percent'].low:.1f} to {joint.intervals['grr_percent'].high:.1f} %),"
        f" it distinguishes {joint.ndc} {'category' if joint.ndc == 1 else 'categories'}: {word}."
    )


def _decision(study: StationGauge) -> Section:
    text = [judgement(joint) for joint in study.joints]
    text.append(
        f"Below {GOOD:.0f} % a gauge is good, above {BAD:.0f} % it is not fit for the purpose (AIAG,"
        f" Measurement Systems Analysis, 4th edition). The tolerance of a zero offset is"
        f" {study.tolerance_deg:g}° wide."
    )
    if len(study.robots) == 1:
        text.append(
            "One robot does not show how robots vary: the total variation is a sixth of the tolerance."
            " Study two or more robots to compare the gauge with their variation."
        )
    everybody = {name for names in study.people for name in names}
    if len(everybody) < study.design.operators:
        text.append(
            f"Only {len(everybody)} {'person' if len(everybody) == 1 else 'persons'} confirmed the mountings"
            f" of {study.design.operators} operators: the reproducibility is not that of different people."
        )
    people = Table(
        ("operator", "confirmed by"),
        [(k + 1, ", ".join(names)) for k, names in enumerate(study.people)],
    )
    return Section("Is the gauge fit for the purpose?", text, (people,))


def _joint(joint: JointStudied) -> Section:
    components = Table(
        ("source", "standard deviation °", "95 % interval °", "% of total", "95 % interval"),
        [
            (
                title,
                f"{getattr(joint, name):.5f}",
                _interval(joint, name, 5),
                f"{getattr(joint, f'{name}_percent'):.1f}" if f"{name}_percent" in joint.intervals else "",
                _interval(joint, f"{name}_percent", 1),
            )
            for name, title in _COMPONENTS.items()
        ],
        "Components of the scatter",
    )
    sources = Table(
        ("source", "standard deviation °", "% of the gauge's variance"),
        [
            (title, f"{getattr(joint.sources, name):.2g}", f"{joint.sources.percent[name]:.1f}")
            for name, title in _SOURCES.items()
        ],
        "What the scatter of the gauge comes from; readout, drives and solver as reckoned from the readings",
    )
    anova = Table(
        ("source", "degrees of freedom", "sum of squares", "mean square", "F", "p"),
        [
            (
                row.source,
                row.dof,
                f"{row.sum_of_squares:.4g}",
                f"{row.mean_square:.4g}",
                "" if row.f is None else f"{row.f:.2f}",
                "" if row.p_value is None else f"{row.p_value:.3f}",
            )
            for row in joint.anova
        ],
        "Analysis of variance",
    )
    names = list(_SOURCES)
    chart = bar(names, [Series("", (), [joint.sources.percent[name] for name in names])], "% of variance")
    return Section(
        f"Joint {joint.joint}",
        (f"Mean {joint.mean_deg:.4f}°.",),
        (components, sources, anova),
        (Chart(chart, "What the scatter of the gauge comes from"),),
    )


def _interval(joint: JointStudied, name: str, digits: int) -> str:
    found = joint.intervals.get(name)
    return "" if found is None else f"{found.low:.{digits}f} to {found.high:.{digits}f}"


def _values(study: StationGauge) -> Section:
    rows = [
        (v.robot, v.operator, v.mounting, v.repeat, *(f"{value:.5f}" for value in v.dtheta_deg))
        for v in study.values
    ]
    columns = ("robot", "operator", "mounting", "calibration", "joint 1 °", "joint 2 °")
    charts = [
        Chart(
            scatter(
                [
                    Series(
                        f"operator {operator}",
                        [float(k) for k, v in enumerate(study.values) if v.operator == operator],
                        [v.dtheta_deg[joint] for v in study.values if v.operator == operator],
                    )
                    for operator in range(1, study.design.operators + 1)
                ],
                "calibration",
                f"zero offset of joint {joint + 1}, °",
            ),
            f"Joint {joint + 1}",
        )
        for joint in range(2)
    ]
    return Section("Values", (), (Table(columns, rows),), charts)
