"""Run an emulated rig: `python -m drivers.emulated RIG.toml [--speed X] [--state FILE]`.

One JSON line on standard output tells the addresses; the rig runs until standard input ends (so it
never outlives whoever started it) or until it is terminated.  A line of standard input is a JSON list of
faults that replaces those ordered before; one line on standard output answers it.
"""

from __future__ import annotations

import argparse
import json
import signal
import sys
from pathlib import Path

from pydantic import ValidationError

from drivers.emulated.orders import ORDERS
from drivers.emulated.rig import EmulatedRig, StateFileError
from drivers.emulated.rig_file import DEFAULT_RIG, RigFileError, load_rig


def main() -> int:
    """0 when ended as told, 2 when the input was refused."""
    parser = argparse.ArgumentParser(prog="python -m drivers.emulated", description=__doc__.splitlines()[0])
    parser.add_argument("rig", nargs="?", type=Path, default=DEFAULT_RIG, help="rig file (TOML)")
    parser.add_argument("--speed", type=_positive, help="how much faster than real time the arms move")
    parser.add_argument("--state", type=Path, help="file that keeps the drives' places between runs")
    arguments = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    try:
        rig = EmulatedRig(load_rig(arguments.rig), speed=arguments.speed, state_file=arguments.state)
        with rig:
            print(json.dumps({"scale_url": rig.scale_url, "servo_url": rig.servo_url}), flush=True)
            for line in sys.stdin:
                print(_ordered(rig, line), flush=True)
    except (RigFileError, StateFileError) as error:
        print(error, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 0
    return 0


def _ordered(rig: EmulatedRig, line: str) -> str:
    """Carry out one line of standard input, a list of faults, and say what is ordered now."""
    try:
        rig.orders.replace(ORDERS.validate_json(line))
    except ValidationError as error:
        first = error.errors()[0]
        where = " ".join(str(part) for part in first["loc"])
        return json.dumps({"error": f"{where}: {first['msg'].removeprefix('Value error, ')}"})
    return json.dumps({"faults": ORDERS.dump_python(rig.orders.given, mode="json")})


def _positive(text: str) -> float:
    value = float(text)
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text} is not a positive number")
    return value


if __name__ == "__main__":
    sys.exit(main())
