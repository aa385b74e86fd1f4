"""A run as the terminal shows it: a bar on a screen, plain lines in a file or pipe."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from station.motion import LiveEvent
from station.records import RunReading, SequenceView
from station.service import Orchestrator


@contextmanager
def progress(console: Console, orchestrator: Orchestrator) -> Iterator[None]:
    """Show what the orchestrator tells, as long as the context lasts."""
    with _bar(console) if console.is_terminal else _lines(console) as show:
        unsubscribe = orchestrator.subscribe(show)
        try:
            yield
        finally:
            unsubscribe()


@contextmanager
def _bar(console: Console) -> Iterator[Callable[[LiveEvent], None]]:
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TextColumn("{task.fields[last]}"),
    )
    with Progress(*columns, console=console) as bar:
        tasks = [bar.add_task("Getting ready", total=None, last="")]

        def show(event: LiveEvent) -> None:
            if isinstance(event.data, SequenceView):
                bar.update(tasks[-1], last="")
                tasks.append(bar.add_task(event.data.title, total=len(event.data.stops), last=""))
            elif isinstance(event.data, RunReading):
                bar.update(tasks[-1], advance=1, last=_reading(event.data))
                bar.update(tasks[0], visible=False)

        yield show


@contextmanager
def _lines(console: Console) -> Iterator[Callable[[LiveEvent], None]]:
    def show(event: LiveEvent) -> None:
        if isinstance(event.data, SequenceView):
            console.print(event.data.title, markup=False)
        elif isinstance(event.data, RunReading):
            console.print(f"  {event.data.reading:>3}  {_reading(event.data)}", markup=False)

    yield show


def _reading(reading: RunReading) -> str:
    return f"{reading.position}  {reading.scale_mm:.4f} mm"
