"""The engine of all studies: machines drawn by seed, all cores or a cluster, progress, resume, a digest."""

from __future__ import annotations

import hashlib
import json
import os
import pickle
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import Any, TypeVar

from rich.console import Console
from rich.progress import Progress

from station.errors import InputRefused

Item = TypeVar("Item")
Result = TypeVar("Result")

FEW = 100
"""Fewer short items are done before processes have started."""
CHUNK = 8
CONNECT_S = 10.0
RETRIES = 3
"""Of a chunk whose worker was lost."""


@dataclass(frozen=True)
class Engine:
    """How a study is carried out; what it finds does not depend on it."""

    console: Console
    workers: int | None = None
    """Processes; None: one for each core."""
    resume: Path | None = None
    """Folder that keeps what was done, so that a study that was ended goes on from there."""
    scheduler: str | None = None
    """Address of a Dask scheduler whose workers do it, `tcp://host:8786`; None: this computer."""

    def each(
        self, work: Callable[[Item], Result], items: Sequence[Item], title: str, *, long: bool = False
    ) -> list[Result]:
        """work(item) for each item, in order.  Items and results must be picklable.

        :param long: each item takes so long that a process of its own is worth it
        """
        size = 1 if long else CHUNK
        chunks = [items[k : k + size] for k in range(0, len(items), size)]
        done: dict[int, list[Result]] = {}
        for k, chunk in enumerate(chunks):
            if (kept := self._kept(title, chunk)) is not None:
                done[k] = kept
        missing = [k for k in range(len(chunks)) if k not in done]
        with Progress(console=self.console, transient=True) as progress:
            bar = progress.add_task(title, total=len(items), completed=sum(len(v) for v in done.values()))
            computed = self._computed(work, [chunks[k] for k in missing], 2 if long else FEW)
            for k, results in zip(missing, computed, strict=True):
                done[k] = results
                self._keep(title, chunks[k], results)
                progress.advance(bar, len(results))
        return [result for k in range(len(chunks)) for result in done[k]]

    def _computed(
        self, work: Callable[[Item], Result], chunks: Sequence[Sequence[Item]], few: int
    ) -> Iterator[list[Result]]:
        """:param few: fewer items than this are done here, before processes have started"""
        if self.scheduler is not None and chunks:
            yield from _on_cluster(self.scheduler, work, chunks)
            return
        if sum(len(chunk) for chunk in chunks) < few or self.workers == 1:
            yield from (_all(work, chunk) for chunk in chunks)
            return
        # matrices of a few hundred rows: threads within a process only stand in each other's way
        os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
        with ProcessPoolExecutor(self.workers, mp_context=get_context("spawn")) as pool:
            yield from pool.map(partial(_all, work), chunks)

    def _kept(self, title: str, chunk: Sequence[Item]) -> list[Any] | None:
        file = self._file(title, chunk)
        if file is None or not file.exists():
            return None
        results: list[Any] = pickle.loads(file.read_bytes())  # noqa: S301 - written by this study
        return results

    def _keep(self, title: str, chunk: Sequence[Item], results: list[Result]) -> None:
        file = self._file(title, chunk)
        if file is None:
            return
        file.parent.mkdir(parents=True, exist_ok=True)
        part = file.with_suffix(".part")
        part.write_bytes(pickle.dumps(results))
        part.rename(file)

    def _file(self, title: str, chunk: Sequence[Item]) -> Path | None:
        """Named after what is asked for: another seed or another study is another file."""
        if self.resume is None:
            return None
        name = hashlib.sha256(pickle.dumps((title, list(chunk)))).hexdigest()[:24]
        return self.resume / f"{name}.pickle"


def _on_cluster(
    scheduler: str, work: Callable[[Item], Result], chunks: Sequence[Sequence[Item]]
) -> Iterator[list[Result]]:
    """In order; what a worker had that was lost is done again by another.

    :raises InputRefused: Dask is not installed, or nobody answers there.
    """
    try:
        from distributed import Client
    except ImportError as error:
        raise InputRefused(
            "--scheduler needs the extra `studies`: pip install fivebar-station[studies]."
        ) from error
    try:
        client = Client(scheduler, timeout=CONNECT_S, set_as_default=False)  # type: ignore[no-untyped-call]
    except (OSError, ValueError) as error:
        raise InputRefused(
            f"No Dask scheduler answers at {scheduler}; start one with `dask scheduler`."
        ) from error
    with client:
        futures = client.map(partial(_all, work), chunks, pure=False, retries=RETRIES)
        for future in futures:
            yield future.result()


def _all(work: Callable[[Item], Result], chunk: Sequence[Item]) -> list[Result]:
    return [work(item) for item in chunk]


def digest(figures: object) -> str:
    """SHA-256 of figures in canonical JSON: the same on one core and on many."""
    text = json.dumps(figures, sort_keys=True, separators=(",", ":"), allow_nan=True)
    return hashlib.sha256(text.encode()).hexdigest()
