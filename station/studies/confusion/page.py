"""The page of the study, docs/confusion.md."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from scipy.stats import binomtest

from station.studies.confusion.claims import Outcome
from station.studies.confusion.kinds import GROUPS, OUTSIDE
from station.studies.confusion.machines import SCATTER_UM
from station.studies.confusion.matrix import Row, reliability

PAGE = """# The diagnosis against random machines

`station confusion --markdown FILE` makes this page: {machines} machines of each kind, seed {seed}. Each
machine is measured as in a run of plan `diagnostic`, with one sample per reading: 120 readings with their
run-ups, then 40 fresh readings with the identified zero offsets subtracted from the commands. Zero offsets,
geometric errors, joints, phases, moments and sizes are random. The sizes are 1 to 30 um of projected RMS,
uniform in the logarithm, and at most four times the usual size. The physics of the emulator share no code
with the catalogue.

- *clear*: every cause is larger than three times the noise of 1.1 um.
- *right*: explained and confirmed with 40 fresh readings; every cause is in the alias set of a finding, and
  nothing else is named. For clean machines: adequate, without a finding.
- *with no alias*: *right*, and no finding has an alias.
- *first*: the most probable explanation contains exactly the causes. For errors without a name: it contains
  no named effect.
- *wrong*: a cause is confirmed that is not present and can be distinguished from those that are. All sizes.
- *3 sd*, *95 %*: the number of machines with a zero offset beyond three standard uncertainties, and the share
  of zero offsets inside their 95 % interval. All sizes.
- *worse*: the true position error is more than 1.2 times that of the base model and exceeds the stated bound.
- *most*: the most frequent results.

| | share | lower and upper 95 % limit |
|---|---|---|
{share_lines}

| in the machine | clear | right | with no alias | first | wrong | 3 sd | 95 % | sd, deg | worse | most |
|---|---|---|---|---|---|---|---|---|---|---|
{machine_lines}

## Probabilities
All statements on effects, in ten bins of equal count.

| stated probability | true share | statements |
|---|---|---|
{reliability_lines}

## Before and after
RMS over all clear machines of a kind, before the diagnosis (base model) and after it (set of explanations).

- *reading*: the difference between 40 fresh readings and their prediction, um, without named outliers.
- *position*: the difference between the true position of the emulated machine and the commanded one, um,
  over a grid of 7 x 5 positions with random approaches. The error of clean machines is the part that one
  distance and the tolerances do not determine.

| in the machine | machines | reading before | after | after over noise | position before | after |
|---|---|---|---|---|---|---|
{error_lines}
"""


def markdown(rows: list[Row], seed: int) -> str:
    """docs/confusion.md."""
    return PAGE.format(
        machines=len(rows[0].outcomes),
        seed=seed,
        share_lines="\n".join(_share_lines(rows)),
        machine_lines="\n".join(_line(row) for row in rows),
        reliability_lines="\n".join(
            f"| {b.stated:.3f} | {b.true:.3f} | {b.count} |" for b in reliability(rows)
        ),
        error_lines="\n".join(_errors_line(row) for row in rows),
    )


def _share_lines(rows: list[Row]) -> list[str]:
    lines = []
    for group in GROUPS:
        some = [row for row in rows if row.group == group]
        if not some:
            continue
        if group == "clean":
            lines.append(_share("clean: no cause named", some, lambda o: o.said == "adequate"))
        elif some[0].kind not in OUTSIDE:
            lines.append(_share(f"{group}, clear: right", some, lambda o: o.right, clear=True))
            lines.append(_share(f"{group}, clear: first", some, lambda o: o.first, clear=True))
        else:
            lines.append(_share(f"{group}: a cause confirmed", some, lambda o: o.confirmed))
    lines.append(_share("all: a wrong cause confirmed", rows, lambda o: o.wrong))
    offs = [off for row in rows for off in row.off_sd]
    lines.append(_counted("all: a zero offset beyond 3 sd", sum(off > 3.0 for off in offs), len(offs)))
    inside = [o.zeros.inside_95 for row in rows for o in row.outcomes if o.zeros is not None]
    lines.append(_counted("all: zero offsets inside their 95 % interval", sum(inside), 2 * len(inside)))
    lines.append(_share("all: position worse, and beyond the stated bound", rows, _worse))
    return lines


def _worse(o: Outcome) -> bool:
    return o.errors is not None and o.errors.worse


def _share(text: str, rows: Sequence[Row], holds: Callable[[Outcome], bool], *, clear: bool = False) -> str:
    some = [o for row in rows for o in (row.clear if clear else row.outcomes)]
    return _counted(text, sum(map(holds, some)), len(some))


def _counted(text: str, part: int, whole: int) -> str:
    if not whole:
        return f"| {text} | - | - |"
    limits = binomtest(part, whole).proportion_ci(method="wilson")
    share = f"{part} of {whole}, {100.0 * part / whole:.1f} %"
    return f"| {text} | {share} | {100.0 * limits.low:.1f} to {100.0 * limits.high:.1f} % |"


def _line(row: Row) -> str:
    clear = row.clear
    most = "; ".join(f"{text} ({count})" for text, count in row.said.most_common(3))
    right = "-" if row.kind in OUTSIDE else f"{sum(o.right for o in clear)}/{len(clear)}"
    return (
        f"| {row.kind} | {len(clear)} | {right} | {sum(o.alone for o in clear)} "
        f"| {sum(o.first for o in clear)}/{len(clear)} | {sum(o.wrong for o in row.outcomes)} "
        f"| {sum(off > 3.0 for off in row.off_sd)} | {100.0 * row.inside_95:.0f} | {row.sd_deg:.3f} "
        f"| {row.worse} | {most} |"
    )


def _errors_line(row: Row) -> str:
    errors = [o.errors for o in row.clear if o.errors is not None]
    reading = _pooled([e.reading_um for e in errors])
    position = _pooled([e.position_um for e in errors])
    ratio = reading[1] / SCATTER_UM
    return (
        f"| {row.kind} | {len(errors)} | {reading[0]:.2f} | {reading[1]:.2f} | {ratio:.2f} "
        f"| {position[0]:.0f} | {position[1]:.0f} |"
    )


def _pooled(rms: list[tuple[float, float]]) -> tuple[float, float]:
    """RMS over all."""
    before, after = np.sqrt(np.mean(np.square(rms), axis=0)) if rms else (np.nan, np.nan)
    return float(before), float(after)
