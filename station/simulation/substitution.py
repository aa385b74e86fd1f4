"""The interface to the simulation: external imports of all production modules are replaced, by name.

Production code has no dependence on it. An object in a default argument or a dataclass field instead of a
name of the module would not be replaced; a test checks for that.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from types import ModuleType

ROOTS = ("station", "drivers", "web")
"""Packages whose names are replaced."""
OWN = "station.simulation"


@contextmanager
def substituted(replacements: Mapping[object, object]) -> Iterator[None]:
    """Bind every name that is bound to a key to its value instead, until the block ends."""
    by_id = {id(real): virtual for real, virtual in replacements.items()}
    done: list[tuple[ModuleType, str, object]] = []
    try:
        for module in production_modules():
            for name, value in list(vars(module).items()):
                if id(value) in by_id:
                    done.append((module, name, value))
                    setattr(module, name, by_id[id(value)])
        yield
    finally:
        for module, name, value in done:
            setattr(module, name, value)


def production_modules() -> list[ModuleType]:
    """All loaded production modules."""
    return [
        module
        for name, module in sorted(sys.modules.items())
        if name.partition(".")[0] in ROOTS and not name.startswith(OWN) and isinstance(module, ModuleType)
    ]
