"""Common fixtures of driver tests, and a check of what they leave behind."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

from drivers.emulated.rig import EmulatedRig
from drivers.emulated.rig_file import DEFAULT_RIG, load_rig


@pytest.fixture(autouse=True)
def nothing_left_behind() -> Iterator[None]:
    """No test leaves a thread, an open file, a port or a terminal."""
    threads, files = set(threading.enumerate()), _open_files()
    yield
    assert set(threading.enumerate()) <= threads
    assert len(_open_files()) <= len(files), _open_files()


def _open_files() -> list[str]:
    """The open files of this process, sorted."""
    names = []
    for entry in Path("/proc/self/fd").iterdir():
        try:
            names.append(str(entry.readlink()))
        except OSError:  # the directory listing's own descriptor
            continue
    return sorted(names)


@pytest.fixture
def rig() -> Iterator[EmulatedRig]:
    """The supplied rig, much faster than real time."""
    with EmulatedRig(load_rig(DEFAULT_RIG), speed=500) as running:
        yield running
