"""The study as a page: every table with the print beside it, every figure drawn."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from station.report import Chart, Page, Section, Series, Table, bar, line, scatter
from station.studies.reproduce.trial import FULL, FULL_DRM, OURS, PAPER, RAPID, RAPID_DRM, RAPID_MEMORY

Content = dict[str, Any]
TITLES = {
    "table3": "Table 3: compensation values and error at home",
    "table4": "Table 4: largest error at the six positions",
    "table5": "Table 5: error of the identified dr_M",
    "table6": "Table 6: mean condition number",
    "table7": "Table 7: compensation values and error at home, experiment",
    "table8": "Table 8: identified dr_M, experiment",
    "table9": "Table 9: largest error at 42 positions, experiment",
}
COLUMNS = {
    "before_mm": "before mm",
    "after_mm": "after mm",
    "zero_offsets_deg": "zero offsets deg",
    "delta_deg": "delta deg",
    "delta_mm": "delta mm",
    "drm_mm": "dr_M mm",
    "kappa_m": "kappa_m",
}
METHODS = (
    "paper: the published iteration, angles as commanded; with feedback: angles as the drives report them. "
    f"{FULL}: 120 readings of plan full; {RAPID}: six readings; {RAPID_MEMORY}: six readings and what one "
    f"full run left before both zero offsets changed; {FULL_DRM} and {RAPID_DRM}: dr_M known to 0.02 mm."
)
LEAD = (
    "Each figure is the median over {seeds} simulated machines with its 5th and 95th percentile in brackets, "
    "one sample of the head a reading. The machine is simulated with physics of its own, from motor pulses "
    "to scale head."
)


def make_page(content: Content) -> Page:
    """From what `station reproduce --json` writes."""
    sections = [_summary(content), _errata(content), _accuracy(content), _coverage(content)]
    sections += [_table(name, content[name]) for name in TITLES]
    sections += [_fig5(content), _fig8(content), _fig9(content), _fig12(content)]
    return Page("Zero-offset calibration: the paper beside this station", LEAD.format(**content), sections)


def _summary(content: Content) -> Section:
    paper = content["paper"]
    rows = [
        ("kappa_1", f"{paper['kappa_1']:.2f}", f"{content['kappa_1']:.2f}"),
        ("kappa_m", f"{paper['kappa_m']:.2f}", f"{content['kappa_m']:.2f}"),
        ("f of eq. 30", paper["f"], content["f"]),
    ]
    noise = [f"Noise {name}: {text}." for name, text in content["noise"].items()]
    return Section("Conditioning, methods, noise", (METHODS, *noise), (Table(("", "printed", "here"), rows),))


def _errata(content: Content) -> Section:
    rows = [(e["where"], e["printed"], e["found"], e["evidence"]) for e in content["errata"]]
    return Section(
        "Where the print errs or is silent", (), (Table(("where", "printed", "found", "evidence"), rows),)
    )


def _accuracy(content: Content) -> Section:
    rows = [
        (
            row["group"],
            row["variant"],
            row["servo"],
            row["samples"],
            _spread(row["workspace_mm"]),
            f"{row['median_error_mm']:.3f}",
            *("" if row[key] is None else f"{row[key]:.3f}" for key in ("bound_mm", "ratio", "target_mm")),
        )
        for row in content["accuracy"]
    ]
    columns = (
        "group",
        "method",
        "servos rest",
        "samples",
        "largest error mm",
        "se of median",
        "bound mm",
        "ratio",
        "target mm",
    )
    plain = [r for r in content["accuracy"] if r["servo"] == "whole pulses" and r["samples"] == 1]
    groups = sorted({r["group"] for r in plain})
    chart = bar(
        [f"group {g}" for g in groups],
        [_bars(variant, [r for r in plain if r["variant"] == variant]) for variant in OURS],
        "largest position error over the workspace, mm",
    )
    return Section(
        "Largest position error over the whole workspace",
        (content["bound"],),
        (Table(columns, rows),),
        (Chart(chart, "Both noises, whole pulses, one sample; whiskers: 5th and 95th percentile."),),
    )


def _bars(variant: str, rows: list[Content]) -> Series:
    spreads = [r["workspace_mm"] for r in rows]
    return Series(
        variant,
        [r["group"] for r in rows],
        [s["median"] for s in spreads],
        [s["p5"] for s in spreads],
        [s["p95"] for s in spreads],
    )


def _coverage(content: Content) -> Section:
    coverage, wrong = content["coverage"], content["coverage"]["wrong_memory"]
    rows = [
        (case, f"{coverage['offsets'][case]:.1%}", f"{coverage['positions'][case]:.1%}")
        for case in coverage["offsets"]
    ]
    places = [
        (
            row["places"],
            row["readings"],
            _spread(row["workspace_mm"]),
            f"{row['median_error_mm']:.3f}",
            f"{row['refused']:.1%}",
            f"{row['predicted']['position_error_mm']['rms']:.3f}",
        )
        for row in content["positions"]
    ]
    return Section(
        "Do the intervals hold, is a wrong memory noticed, what are chosen places worth",
        (
            f"{coverage['machines']} machines drawn from the tolerances. Interval: {coverage['interval']}. "
            f"Position interval: {coverage['position_interval']}.",
            f"A right memory was kept in {coverage['memory_kept']:.1%}; one of a mechanism since mounted "
            f"{wrong['mounted_off_mm']:g} mm off was dropped in {wrong['dropped']:.1%}.",
        ),
        (
            Table(("case", "zero offsets held", "positions held"), rows),
            Table(
                ("places", "readings", "largest error mm", "se of median", "refused", "predicted rms mm"),
                places,
                "One reading at each place.",
            ),
        ),
    )


def _table(name: str, rows: list[Content]) -> Section:
    figures = [key for key in COLUMNS if key in rows[0] and key != "before_mm"]
    before = "before_mm" in rows[0]
    columns = ["group", "method", "noise", *(["before mm"] if before else []), *(COLUMNS[f] for f in figures)]
    cells: list[list[object]] = []
    for row in rows:
        paper = row["paper"]
        printed = [_cell(paper[key]) for key in figures]
        cells.append(
            [row["group"], "printed", "", *([_cell(paper["before_mm"])] if before else []), *printed]
        )
        for result in row["results"]:
            own = [_cell(result[key]) for key in figures]
            without = [_cell(row["before_mm"])] if before else []
            cells.append([row["group"], result["variant"], result["noise"], *without, *own])
    label = (f"Rows other than the print: {rows[0]['label']}.",) if "label" in rows[0] else ()
    return Section(TITLES[name], label, (Table(columns, cells),))


def _cell(value: Any) -> str:
    if isinstance(value, list):
        return " / ".join(_cell(v) for v in value)
    return _spread(value) if isinstance(value, dict) else _number(value)


def _spread(value: dict[str, float]) -> str:
    return f"{_number(value['median'])} [{_number(value['p5'])}, {_number(value['p95'])}]"


def _number(value: float) -> str:
    return f"{value:.2f}" if abs(value) >= 100.0 else f"{value:.3f}"


def _fig5(content: Content) -> Section:
    charts = [
        Chart(
            line(
                [Series(s["parameter"], s["x"], s["error_mm"]) for s in content["fig5"] if s["unit"] == unit],
                f"source error, {unit}",
                "distance error of P_0, mm",
            ),
            caption,
        )
        for unit, caption in (("deg", "a) zero offset"), ("mm", "b) geometric errors"))
    ]
    rows = [(s["parameter"], f"{s['per_unit_mm']:.4f}", f"mm/{s['unit']}") for s in content["fig5"]]
    return Section(
        "Fig. 5: sensitivity of the error at home",
        (),
        (Table(("source error", "sensitivity", "unit"), rows),),
        charts,
    )


def _fig8(content: Content) -> Section:
    n = [row["n"] for row in content["fig8"]]
    series = [Series(key, n, [row[key] for row in content["fig8"]]) for key in ("kappa_1", "kappa_m")]
    rows = [
        (r["n"], f"{r['kappa_1']:.2f}", f"{r['kappa_m']:.2f}", f"{r['epsilon']:.4f}") for r in content["fig8"]
    ]
    return Section(
        "Fig. 8: condition numbers against n",
        (),
        (Table(("n", "kappa_1", "kappa_m", "epsilon"), rows),),
        (
            Chart(
                line(series, "n, positions on each edge", "condition number"),
                "One machine is like the other here.",
            ),
        ),
    )


def _fig9(content: Content) -> Section:
    charts = list(_robustness(content))
    return Section(
        "Fig. 9: compensation values and mu against m",
        ("Bands: 5th to 95th percentile. The calibration ends with the first mu below 0.1 deg.",),
        (
            Table(
                ("group", "noise", "ended within ten passes"),
                [(row["group"], row["noise"], f"{row['converged']:.0%}") for row in content["fig9"]],
            ),
        ),
        charts,
    )


def _robustness(content: Content) -> Iterator[Chart]:
    for row in content["fig9"]:
        name = f"group {row['group']}, noise: {row['noise']}"
        values = [_band(label, row["m"], row[f"{label}_deg"]) for label in ("dtheta1", "dtheta2")]
        yield Chart(line(values, "m", "compensation value, deg"), name)
        mu = [_band("mu", row["m"][1:], row["mu_deg"])]
        yield Chart(line(mu, "m", "mu, deg", log_y=True), name)


def _band(label: str, m: list[int], spreads: list[dict[str, float]]) -> Series:
    return Series(
        label,
        m,
        [s["median"] for s in spreads],
        [s["p5"] for s in spreads],
        [s["p95"] for s in spreads],
    )


def _fig12(content: Content) -> Section:
    charts = []
    for row in content["fig12"]:
        number = list(range(1, len(row["before_mm"]) + 1))
        after = {(a["variant"], a["noise"]): a["median_mm"] for a in row["after"]}
        series = [
            Series("before", number, row["before_mm"]),
            Series("paper, scale", number, after[PAPER, "scale"]),
            Series("paper, scale and servo", number, after[PAPER, "scale and servo"]),
            Series(FULL, number, after[FULL, "scale and servo"]),
            Series(RAPID_MEMORY, number, after[RAPID_MEMORY, "scale and servo"]),
        ]
        charts.append(
            Chart(
                scatter(series, "position along the edge", "position error, mm", log_y=True),
                f"group {row['group']}, median after calibration",
            )
        )
    return Section(
        "Fig. 12: error at the 42 positions of Fig. 11",
        ("Simulated; the paper's figure was measured. Positions from the upper left corner clockwise.",),
        (),
        charts,
    )
