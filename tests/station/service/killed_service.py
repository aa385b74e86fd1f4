"""Kills the real service at random instants while a program follows its runs, to check that nothing is lost.

`python -m tests.station.service.killed_service [--kills N] [--seed S] [--resume FILE]`: one `station serve`
on the emulated rig gets a run over REST, is followed on the live feed and killed (SIGKILL), N times. After
each restart every reading that the feed showed is stored unchanged, a reported end remains, the same key
returns the same run, and the next run succeeds. At the end the chain of records is intact and the receiver
has every end, in order. `--resume` stores completed kills, one per line.
"""

from __future__ import annotations

import argparse
import json
import random
import subprocess
import sys
import tempfile
import time
from contextlib import suppress
from dataclasses import asdict, dataclass
from pathlib import Path
from threading import Thread

from websockets.exceptions import WebSocketException
from websockets.sync.client import connect

from fivebar_client import CalibrationBody, Station
from station.people import new_secret, secret_hash
from station.records import Actor, RunReading
from station.store import Store
from tests.served import ROOT, Served

LONGEST_S = 3.5
"""Time after the request; a run takes less, so that ends, deliveries and idle times are hit too."""
_TOML = """[service]
open = false
[emulated]
speed = 10
[[outbox.folder]]
path = "{told}"
events = ["run.ended"]
"""


@dataclass(frozen=True)
class Blow:
    """One kill, and its result."""

    after_s: float
    state: str
    """State of the run that was active, or had just ended."""
    shown: int
    """Readings that the feed had shown."""
    kept: int
    wrong: str
    """Empty if all requirements are met."""


class Follower:
    """The messages of the live feed, until it breaks."""

    def __init__(self, url: str, key: str) -> None:
        self.shown: dict[str, dict[int, RunReading]] = {}
        """By the uid of the run and the number of the reading."""
        self.told: dict[str, str] = {}
        """The reported end of each run."""
        self._uid = ""
        feed = f"ws{url.removeprefix('http')}/api/v1/live"
        self._connection = connect(feed, additional_headers={"Authorization": f"Bearer {key}"})
        self._thread = Thread(target=self._follow)
        self._thread.start()

    def close(self) -> None:
        self._connection.close()
        self._thread.join()

    def _follow(self) -> None:
        with suppress(WebSocketException, OSError):
            for message in self._connection:
                told = json.loads(message)
                data = told["data"]
                if told["type"] == "run":
                    self._uid = data["uid"]
                elif told["type"] == "reading":
                    reading = RunReading.model_validate(data)
                    self.shown.setdefault(self._uid, {})[reading.reading] = reading
                elif told["type"] == "ended":
                    self.told[data["uid"]] = data["state"]


class Bench:
    """A station, its MES, and the history of both."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.key = new_secret("fbs_")
        store = Store(folder / "station.db")
        store.add_key(Actor(name="root", via="terminal"), "line 4", "mes", secret_hash(self.key), None)
        store.close()
        self.served = Served(folder, _TOML.format(told=folder / "told"))
        self._asked = 0

    def blow(self, after_s: float) -> Blow:
        """Start, let a run succeed, kill in the next one, start again and check."""
        self._asked += 1
        key = f"job {self._asked}"
        order = CalibrationBody(robot_serial="FB-1", plan="rapid", operator="line 4")
        follower = Follower(self.served.url, self.key)
        try:
            with Station(self.served.url, self.key) as mes:
                run = mes.start(order, key)
                time.sleep(after_s)
                self.served.kill()
        finally:
            follower.close()
        self.served.start()
        with Station(self.served.url, self.key) as mes:
            wrong = [*self._looked_at(mes, run.id, follower), *self._goes_on(mes, order, key, run.id)]
            kept = mes.run(run.id)
            readings = len(mes.readings(run.id))
        shown = len(follower.shown.get(run.uid, {}))
        return Blow(round(after_s, 3), kept.state, shown, readings, "; ".join(wrong))

    def _looked_at(self, mes: Station, number: int, follower: Follower) -> list[str]:
        run = mes.run(number)
        kept = {row.reading: row for row in mes.readings(number)}
        wrong = []
        for reading, row in follower.shown.get(run.uid, {}).items():
            same = kept.get(reading)
            if same is None:
                wrong.append(f"reading {reading} was shown and is not kept")
            elif (same.scale_mm, same.theta1_deg, same.theta2_deg) != (
                *(row.scale_mm, row.theta1_deg, row.theta2_deg),
            ):
                wrong.append(f"reading {reading} is kept otherwise than shown")
        told = follower.told.get(run.uid)
        if told is not None and run.state != told:
            wrong.append(f"told {told} and kept as {run.state}")
        if told is None and run.state not in ("interrupted", "succeeded"):
            wrong.append(f"kept as {run.state}")
        return wrong

    def _goes_on(self, mes: Station, order: CalibrationBody, key: str, number: int) -> list[str]:
        if (again := mes.start(order, key).id) != number:
            return [f"the same key started run {again}"]
        following = mes.wait(mes.start(order, f"{key}, then").id, every_s=0.1)
        return [] if following.verdict == "pass" else [f"the next run {following.state}: {following.reason}"]

    def whole(self) -> str:
        """While the station is off: the fault in the chain or in the deliveries, or empty."""
        verified = subprocess.run(
            [sys.executable, "-m", "station", "--home", str(self.folder), "verify"],
            capture_output=True,
            text=True,
            cwd=ROOT,
        )
        if verified.returncode:
            return verified.stdout + verified.stderr
        numbers = [json.loads(f.read_text()) for f in sorted((self.folder / "told").glob("*.json"))]
        told = [event["data"]["id"] for event in numbers]
        if told != sorted(told):
            return "the receiver heard of the ends in another order"
        store = Store(self.folder / "station.db")
        try:
            runs = [run.id for run in store.calibrations(limit=1_000_000, order="oldest").items]
        finally:
            store.close()
        return "" if told == runs else f"the receiver never heard of {sorted(set(runs) - set(told))}"


def all_blows(kills: int, seed: int, resume: Path | None) -> tuple[list[Blow], str]:
    """All kills, earlier ones included, and the faults at the end."""
    done = resume.read_text().splitlines() if resume is not None and resume.exists() else []
    blows = [Blow(**json.loads(line)) for line in done]
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(Path(folder))
        bench.served.start()
        try:
            for number in range(len(blows), kills):
                blows.append(bench.blow(random.Random(f"{seed} {number}").uniform(0.0, LONGEST_S)))
                line = json.dumps(asdict(blows[-1]))
                print(line, flush=True)
                if resume is not None:
                    with resume.open("a") as out:
                        out.write(f"{line}\n")
            time.sleep(2.0)  # pending events are delivered
        finally:
            bench.served.end()
        return blows, bench.whole()


def main() -> int:
    """0, or 1 if a requirement is violated."""
    parser = argparse.ArgumentParser(prog="python -m tests.station.service.killed_service")
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--resume", type=Path)
    arguments = parser.parse_args()
    blows, trouble = all_blows(arguments.kills, arguments.seed, arguments.resume)
    wrong = [blow for blow in blows if blow.wrong]
    under_way = sum(blow.state == "interrupted" for blow in blows)
    print(
        f"{len(blows)} kills, {under_way} of them during a run; readings shown {sum(b.shown for b in blows)},"
        f" kept {sum(b.kept for b in blows)}; {len(wrong)} wrong. {trouble or 'Chain and deliveries whole.'}"
    )
    return 1 if wrong or trouble else 0


if __name__ == "__main__":
    sys.exit(main())
