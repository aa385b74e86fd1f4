"""A study on a cluster that loses a worker, in a separate process, since Dask leaves threads behind."""

from __future__ import annotations

import os
import signal
import sys
import time
from threading import Timer

from distributed import LocalCluster
from rich.console import Console

from station.errors import InputRefused
from station.studies import engine as studies
from station.studies.engine import FEW, Engine

QUIET = Console(quiet=True)


def slowly(number: int) -> int:
    time.sleep(0.02)
    return number * number


def refused(address: str) -> bool:
    """Whether the missing answer is reported."""
    try:
        Engine(QUIET, scheduler=address).each(slowly, [1], "Squares")
    except InputRefused as refusal:
        return "No Dask scheduler answers" in str(refusal)
    return False


def main() -> int:
    studies.CONNECT_S = 1.0
    with LocalCluster(  # type: ignore[no-untyped-call]
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, silence_logs=50
    ) as cluster:
        lost = next(iter(cluster.workers.values())).pid
        timer = Timer(0.3, os.kill, (lost, signal.SIGKILL))
        timer.start()
        engine = Engine(QUIET, scheduler=cluster.scheduler_address)
        found = engine.each(slowly, list(range(FEW)), "Squares")
        timer.join()
        kept = lost not in [worker.pid for worker in cluster.workers.values()]
    same = found == [n * n for n in range(FEW)]
    return 0 if same and kept and refused("tcp://127.0.0.1:9") and refused("nowhere") else 1


if __name__ == "__main__":
    sys.exit(main())
