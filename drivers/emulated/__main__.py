"""Run an emulated rig: `python -m drivers.emulated RIG.toml [--speed X] [--state FILE]`.

One JSON line on standard output contains `[scale]`, `[servo]` and `[interlocks]` of a station file for it;
the rig runs until standard input ends (so it never outlives the process that started it) or until it is
terminated.  A line of standard input is JSON with `faults` or `effects` that replace those ordered before, or
a `mount` of the mechanism; one line on standard output is the answer.
"""

from __future__ import annotations

import argparse
import json
import signal
import sys
from pathlib import Path

from pydantic import ConfigDict, ValidationError

from drivers.emulated.imperfections import AnyEffect
from drivers.emulated.orders import FaultOrder
from drivers.emulated.rig import EmulatedRig, StateFileError
from drivers.emulated.rig_file import DEFAULT_RIG, RigFileError, load_rig
from drivers.strict_numbers import StrictNumbers


class Order(StrictNumbers):
    """A line of standard input: replacements for earlier orders; omitted ones are unchanged."""

    model_config = ConfigDict(extra="forbid")

    faults: tuple[FaultOrder, ...] | None = None
    effects: tuple[AnyEffect, ...] | None = None
    mount: tuple[float, float, int] | None = None
    """New mounting point of the mechanism, mm, and the number of this mounting there."""


def main() -> int:
    """0 after a regular end, 2 when the input was refused."""
    parser = argparse.ArgumentParser(prog="python -m drivers.emulated", description=__doc__.splitlines()[0])
    parser.add_argument("rig", nargs="?", type=Path, default=DEFAULT_RIG, help="rig file (TOML)")
    parser.add_argument("--speed", type=_positive, help="how much faster than real time the arms move")
    parser.add_argument("--state", type=Path, help="file that keeps the drives' places between runs")
    arguments = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    try:
        rig = EmulatedRig(load_rig(arguments.rig), speed=arguments.speed, state_file=arguments.state)
        with rig:
            found = {
                "scale": rig.scale_options,
                "servo": rig.servo_options,
                "interlocks": rig.interlock_options,
            }
            print(json.dumps(found), flush=True)
            for line in sys.stdin:
                print(_ordered(rig, line), flush=True)
    except (RigFileError, StateFileError) as error:
        print(error, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 0
    return 0


def _ordered(rig: EmulatedRig, line: str) -> str:
    """Carry out one line of standard input, and return the active orders."""
    try:
        order = Order.model_validate_json(line)
    except ValidationError as error:
        first = error.errors()[0]
        where = " ".join(str(part) for part in first["loc"])
        return json.dumps({"error": f"{where}: {first['msg'].removeprefix('Value error, ')}"})
    if order.faults is not None:
        rig.orders.replace(order.faults)
    if order.effects is not None:
        rig.machine.replace_effects(order.effects)
    if order.mount is not None:
        x, y, mounting = order.mount
        rig.machine.remount((x, y), mounting)
    return order.model_dump_json()


def _positive(text: str) -> float:
    value = float(text)
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text} is not a positive number")
    return value


if __name__ == "__main__":
    sys.exit(main())
