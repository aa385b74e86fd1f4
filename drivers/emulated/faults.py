"""Scripted wire faults: the fault that is due on an occasion."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from threading import Lock

from drivers.emulated.spec import Fault, FaultKind


@dataclass(slots=True)
class _Script:
    fault: Fault
    passed: int = 0


class Faults:
    """The script, shared by all emulated devices of a rig; may be used from any thread."""

    def __init__(self, faults: Iterable[Fault] = ()) -> None:
        self._lock = Lock()
        self._scripts = [_Script(fault) for fault in faults]

    def add(self, fault: Fault) -> None:
        """Add a fault, counted from now."""
        with self._lock:
            self._scripts.append(_Script(fault))

    def clear(self) -> None:
        """No more faults."""
        with self._lock:
            self._scripts.clear()

    def due(self, kind: FaultKind, joint: int | None = None) -> Fault | None:
        """Report an occasion for `kind` to the script; returns the fault if it strikes now."""
        with self._lock:
            struck: Fault | None = None
            for script in self._scripts:
                fault = script.fault
                if fault.kind != kind or fault.joint not in (None, joint):
                    continue
                script.passed += 1
                if fault.after < script.passed <= fault.after + fault.times:
                    struck = struck or fault
            return struck
