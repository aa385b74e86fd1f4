"""The one seam: what production modules import from the world outside is replaced, by name, in all of them.

Production code itself knows nothing of it.  What is held by a default argument or a dataclass field instead
of a name of the module would escape; a test looks for that.
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
    """Every name that is bound to a key is bound to its value instead, until the block ends."""
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
    """Those that are loaded."""
    return [
        module
        for name, module in sorted(sys.modules.items())
        if name.partition(".")[0] in ROOTS and not name.startswith(OWN) and isinstance(module, ModuleType)
    ]
