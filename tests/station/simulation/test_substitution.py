"""Nothing in production code holds a real clock or thread that the simulation could not replace."""

from __future__ import annotations

import dataclasses
import inspect
import queue
import threading
import time
from collections.abc import Iterator

from drivers.lines import open_port
from station.simulation import live
from station.simulation.substitution import production_modules, substituted

REAL = {
    id(real): repr(real)
    for real in (
        *(time.monotonic, time.monotonic_ns, time.time, time.time_ns, time.sleep),
        *(threading.Thread, threading.Event, threading.Lock, threading.RLock, threading.Condition),
        *(queue.Queue, open_port),
    )
}
GIVEN_OTHERWISE = {
    "drivers.emulated.machine.Machine",
    "drivers.emulated.orders.Orders",
    "drivers.emulated.siko_head.SikoDevice",
    "station.outbox.webhook.Webhook",
    "station.people.openid.OpenId",
    "station.people.tries.Tries",
}
"""Classes whose clock is an argument, which the simulation gives, or which it does not use."""


def _held() -> Iterator[tuple[str, str]]:
    """Where a default argument or a field holds something real, and what."""
    for module in production_modules():
        for name, value in list(vars(module).items()):
            if getattr(value, "__module__", None) != module.__name__:
                continue
            where = f"{module.__name__}.{name}"
            functions = [value] if inspect.isfunction(value) else []
            if inspect.isclass(value):
                functions += [f for f in vars(value).values() if inspect.isfunction(f)]
                if dataclasses.is_dataclass(value):
                    for field in dataclasses.fields(value):
                        if id(field.default_factory) in REAL:
                            yield where, REAL[id(field.default_factory)]
            for function in functions:
                for default in (*(function.__defaults__ or ()), *(function.__kwdefaults__ or {}).values()):
                    if id(default) in REAL:
                        yield where, REAL[id(default)]


def test_nothing_real_is_held_by_a_default() -> None:
    live(seed=1, days=0)  # loads all that a station is made of
    held = {(where, what) for where, what in _held() if where not in GIVEN_OTHERWISE}
    assert held == set()


def test_everything_is_put_back() -> None:
    from station.motion import machine

    with substituted({time: "the time"}):
        assert vars(machine)["time"] == "the time"
    assert vars(machine)["time"] is time
