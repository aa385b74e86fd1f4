"""`python -m station.studies.training`: the reports of the station on secret errors."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

import click
from rich.console import Console

from station.errors import NotApplicable, NotFound
from station.records import CalibrationRequest, Exercise, Said
from station.service import KINDS, Runtime, TrainingDesk
from station.settings import EmulatedSettings, Settings
from station.studies.options import page_option

SERIAL = "TRAINING"
RUN_LIMIT_S = 900.0
ABOUT = """# The training desk, worked through

Each of the first {exercises} exercises is drawn by the station in secret: an effect of the catalogue, or an
error outside the catalogue. Each exercise is worked through as a trainee would do it: a run of plan
`diagnostic`, then, if further motion can distinguish the remaining explanations, that motion, then the
disclosure. After these, each fault of devices and lines follows once. The machine is the emulated one behind
its wires, {speed:g} times faster than real time.

The scores:

- `found`: the cause is named, alone or together with causes that cannot be distinguished from it. For an
  error without a name: the residual is not explained, and no cause is confirmed. For a fault: the run failed
  and names the device.
- `partly`: something else is named beside the cause, or the cause is only a possible explanation.
- `noticed`: the run does not pass, but the cause is not named.
- `wrong`: another cause is named.
- `missed`: the run passes as good.
- `withstood`: the run succeeds in spite of the fault.

`python -m station.studies.training --exercises {exercises} --seed {seed}` makes this page. The noise of the
emulated machine is drawn anew each time, so single lines may differ."""


@click.command()
@click.option(
    "--exercises",
    default=20,
    show_default=True,
    type=click.IntRange(1),
    help="Number of drawn exercises.",
)
@click.option(
    "--seed", default=1, show_default=True, type=click.IntRange(0), help="Seed of the random numbers."
)
@click.option(
    "--speed",
    default=50.0,
    show_default=True,
    type=click.FloatRange(1, 1000),
    help="Speed factor of the emulated machine.",
)
@page_option
def main(exercises: int, seed: int, speed: float, out: Path | None) -> None:
    """Compare secret errors with the reports of the station."""
    settings = Settings(emulated=EmulatedSettings(speed=speed))
    console = Console(stderr=True)
    done: list[Exercise] = []
    with TemporaryDirectory() as home, Runtime.open(settings, Path(home)) as runtime:
        for exercise in _worked_through(runtime, exercises, Random(seed)):
            done.append(exercise)
            console.print(_row(exercise), highlight=False, soft_wrap=True)
    about = ABOUT.format(speed=speed, exercises=exercises, seed=seed)
    effects, faults = done[:exercises], done[exercises:]
    head = "| no. | drawn | joint | size | report of the station | score |\n|---|---|---|---|---|---|"
    rows = "\n".join(_row(exercise) for exercise in done)
    counts = f"{_counts('errors of the machine', effects)}\n{_counts('faults', faults)}"
    text = f"{about}\n\n{counts}\n\n{head}\n{rows}\n"
    if out:
        out.write_text(text, encoding="utf-8")
    click.echo(text)


def _worked_through(runtime: Runtime, exercises: int, rng: Random) -> Iterator[Exercise]:
    assert runtime.rig is not None
    orchestrator = runtime.orchestrator
    desk = TrainingDesk(runtime.rig, runtime.store, lambda: orchestrator.running, rng)
    faults = [(name, 1 if kind.joint else None) for name, kind in KINDS.items() if kind.group == "fault"]
    for number in range(exercises + len(faults)):
        if number < exercises:
            desk.draw(("catalogue", "unnamed"))
        else:
            desk.choose(*faults[number - exercises], None)
        run = orchestrator.submit(CalibrationRequest(SERIAL, "diagnose", "trainee", plan="diagnostic")).id
        orchestrator.wait(run, RUN_LIMIT_S)
        desk.view()
        _distinguish(runtime, run)
        desk.repair()
        yield desk.view().done[0]


def _distinguish(runtime: Runtime, run: int) -> None:
    """The further motion, if there is one."""
    try:
        further = runtime.orchestrator.follow("separate", run, "trainee").id
    except (NotApplicable, NotFound):  # nothing to distinguish, or the run failed
        return
    runtime.orchestrator.wait(further, RUN_LIMIT_S)


def _counts(what: str, done: Sequence[Exercise]) -> str:
    scores = Counter(str(exercise.score) for exercise in done)
    return f"- {len(done)} {what}: {', '.join(f'{score} {n}' for score, n in scores.most_common())}"


def _row(exercise: Exercise) -> str:
    challenge, said = exercise.challenge, exercise.said
    assert challenge is not None
    size = "" if exercise.size is None else f"{exercise.size:g} {challenge.unit}"
    heard = "" if said is None else _words(said)
    cells = (exercise.n, challenge.kind, exercise.joint or "", size, heard, exercise.score)
    return f"| {' | '.join(map(str, cells))} |"


def _words(said: Said) -> str:
    if said.diagnosis is None:
        return f"{said.state}: {said.reason}"
    at = [f"{c.effect} {c.part or (f'of joint {c.joint}' if c.joint else '')}".strip() for c in said.causes]
    confirmed = {True: ", confirmed", False: ", not confirmed", None: ""}[said.confirmed]
    return f"{said.diagnosis}{confirmed}: {', '.join(at) or 'no cause'} (outcome {said.outcome})"


if __name__ == "__main__":
    main()
