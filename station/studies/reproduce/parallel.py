"""Work on every core, with progress."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from typing import TypeVar

from rich.console import Console
from rich.progress import Progress

Item = TypeVar("Item")
Result = TypeVar("Result")

FEW = 100
"""Fewer items are done before processes have started."""
CHUNK = 8


def each(work: Callable[[Item], Result], items: Sequence[Item], title: str, console: Console) -> list[Result]:
    """work(item) for each item, in order."""
    with Progress(console=console, transient=True) as progress:
        if len(items) < FEW:
            return [work(item) for item in progress.track(items, description=title)]
        # matrices of a few hundred rows: threads within a process only stand in each other's way
        os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
        with ProcessPoolExecutor(mp_context=get_context("spawn")) as pool:
            results = pool.map(work, items, chunksize=CHUNK)
            return list(progress.track(results, total=len(items), description=title))
