"""A sample of the fault matrix: see `python -m tests.drivers.fault_matrix`."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack

import pytest

from tests.drivers.fault_matrix import Bench

SAMPLE = [
    ("line", "garbage", "move"),
    ("scale", "contaminated", "retract"),
]


@pytest.fixture(scope="module")
def bench(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Bench]:
    with ExitStack() as stack:
        yield Bench(("leadshine-el7", "heidenhain-nd", "tcp"), tmp_path_factory.mktemp("bench"), stack)


@pytest.mark.parametrize(("device", "kind", "step"), SAMPLE)
def test_a_fault_is_named_and_the_next_run_succeeds(bench: Bench, device: str, kind: str, step: str) -> None:
    cell = bench.cell(device, kind, step)
    assert not cell.wrong, f"{cell.wrong}; the run with the fault: {cell.reason}"
