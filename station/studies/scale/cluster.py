"""A study on a cluster of this computer that loses a worker on the way."""

from __future__ import annotations

import os
import signal
from threading import Timer

from distributed import LocalCluster
from rich.console import Console

from station.studies.engine import Engine, digest
from station.studies.population import FIGURES, population


def digest_after_a_loss(machines: int, seed: int, after_s: float) -> tuple[str, bool]:
    """Digest of study `accuracy` on two workers, and whether one of them was killed before the end."""
    with LocalCluster(  # type: ignore[no-untyped-call]
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, silence_logs=50
    ) as cluster:
        lost = next(iter(cluster.workers.values())).pid
        timer = Timer(after_s, os.kill, (lost, signal.SIGKILL))
        timer.start()
        engine = Engine(Console(stderr=True), scheduler=cluster.scheduler_address)
        found = FIGURES["accuracy"](population(machines, seed, engine, "full", 0.03))
        timer.cancel()
        killed = lost not in [worker.pid for worker in cluster.workers.values()]
    return digest(found), killed
