"""Identifications timed on one thread, ours and peers; run as a process of its own, JSON on its output."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from functools import partial
from typing import Any

import numpy as np
from scipy.optimize import least_squares

from station.records import Real
from station.studies.bench import diagnoses, peers
from station.studies.bench.problems import Problem, four_by_60, thirteen_by_60
from station.studies.bench.timing import time_ms

PROBLEMS = {"identify_4x60": four_by_60, "identify_13x60": thirteen_by_60}
STARTS = 12
ONE_THREAD = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")


def measured_alone(seconds: float) -> dict[str, Any]:
    """`measure` in a process with one thread."""
    command = [sys.executable, "-m", __name__, f"{seconds:g}"]
    alone = {**os.environ, **dict.fromkeys(ONE_THREAD, "1")}
    done = subprocess.run(command, env=alone, stdout=subprocess.PIPE, text=True, check=True)
    answer: dict[str, Any] = json.loads(done.stdout)
    return answer


def measure(seconds: float) -> dict[str, Any]:
    """{ours: {figure by name}, agreement: {problem: relative}, peers: {name: {figure by name}}}"""
    problems = {name: make() for name, make in PROBLEMS.items()}
    return {
        "ours": {f"{name}_ms": time_ms(p.solve, seconds=seconds) for name, p in problems.items()}
        | diagnoses.measure(seconds),
        "agreement": {name: agreement(p) for name, p in problems.items()},
        "peers": {
            peer: {f"{name}_ms": time_ms(make(p), seconds=seconds) for name, p in problems.items()}
            for peer, make in peers.installed().items()
        },
    }


def agreement(problem: Problem) -> float:
    """Relative distance between our answer and a general solver's.

    That solver stops where its cost no longer changes in double precision, a little short along the
    weak direction; of its ways there the one with the least gradient left is compared.
    """

    ours = problem.solve()

    def left(x: Real) -> float:
        gradient = problem.stacked_jacobian(x).T @ problem.stacked(x)
        return float(gradient @ ours.covariance @ gradient)

    general = partial(
        least_squares, problem.stacked, jac=problem.stacked_jacobian, xtol=1e-15, ftol=1e-15, gtol=1e-15
    )
    rng = np.random.default_rng(0)
    found: list[Real] = []
    for _ in range(STARTS):
        x = problem.start + rng.normal(0.0, 1e-3, len(problem.start))
        x = general(x0=x, method="dogbox", x_scale="jac").x
        found += [x, general(x0=x, method="lm").x]
    best = min(found, key=left)
    return float(np.linalg.norm(ours.x - best) / np.linalg.norm(best))


if __name__ == "__main__":
    print(json.dumps(measure(float(sys.argv[1]))))
