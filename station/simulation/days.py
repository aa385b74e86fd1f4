"""The events at a station from morning to evening, drawn by a seed.

A day begins with a start and ends with a shutdown, a kill or a power cut.  In between people and programs
request runs, and there are disturbances: people abort and stop, start twice, do not answer; wires, devices,
disk and clock have faults; the process is killed.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from random import Random
from typing import TypeVar

from drivers.emulated.orders import KINDS, Device, FaultOrder
from station.five_bar import Robot
from station.records import PlanName
from station.simulation.disk import FOR_GOOD, DiskTrouble
from station.simulation.jobs import WHOLE, Job, Request, Script
from station.simulation.keeper import RUN_LIMIT_S, Keeper, Stranded
from station.simulation.people import People
from station.simulation.plant import Plant
from station.simulation.witness import Witness

T = TypeVar("T")

ROBOT = Robot.default()
ABORT_LIMIT_S = 20.0
"""Virtual time within which an aborted run has ended."""
_NIGHT_S = 14 * 3600.0
_KILLED_AT_NIGHT = 0.2
_RUNS_A_DAY = (3, 8)
_PLANS: dict[PlanName, float] = {
    "paper": 40,
    "rapid": 22,
    "adaptive": 20,
    "check": 10,
    "reference": 4,
    "two_mounts": 2,
    "full": 2,
}
DEEDS = {"measure": 73.0, "apply": 20.0, "rollback": 4.0, "retract": 3.0}
TROUBLES = {
    "none": 42.0,
    "device": 18.0,
    "abort": 8.0,
    "stop": 5.0,
    "stop while a drive is silent": 3.0,
    "kill": 6.0,
    "kill at a write": 4.0,
    "disk": 5.0,
    "disk, then kill": 1.0,
    "clock": 3.0,
    "double start": 3.0,
    "second start": 2.0,
}
"""Relative frequency of each."""
_CHANGE_THE_MACHINE = ("jump", "lost_counts", "reboot", "unit", "frozen", "contaminated", "overspeed")
"""Faults after which the readings do not represent the machine: its true values are no reference."""
_NEW_KEY, _STRANGER = 0.05, 0.3
"""Number per day."""
_CLOCK_STEPS_S = (-3600.0, -60.0, 90.0, 3600.0, 315_360_000.0)


@dataclass
class Days:
    """Generates the days of one plant."""

    keeper: Keeper
    seed: str
    deeds: Mapping[str, float]
    troubles: Mapping[str, float]
    script: Script = WHOLE
    happened: Counter[str] = field(default_factory=Counter)
    jobs: list[Job] = field(default_factory=list)
    """Jobs that were carried out."""
    _day: int = -1
    _first: bool = True

    def __post_init__(self) -> None:
        self.random = Random(self.seed)
        """Random numbers of the day, or of the current job."""
        self.people = People(self.plant, Random(f"{self.seed} people"))

    @property
    def plant(self) -> Plant:
        return self.keeper.plant

    @property
    def witness(self) -> Witness:
        return self.keeper.witness

    def day(self) -> None:
        """One day, to the next morning."""
        plant = self.plant
        self._day += 1
        self.random = random = Random(f"{self.seed} day {self._day}")
        if random.random() < 0.3:
            plant.bring(random.randrange(len(plant.machines)))
        if self.script.has_day(self._day):
            self._open(random)
        plant.clocks.set_s += _NIGHT_S

    def _open(self, random: Random) -> None:
        """The time in which the station is on."""
        plant = self.plant
        for receiver in plant.receivers.values():
            receiver.fails = random.choice((0.0, 0.0, 0.0, 0.3, 0.8))
        self.keeper.start()
        self._people_come()
        killed_after_s = random.uniform(1.0, 20.0) if random.random() < _KILLED_AT_NIGHT else None
        for number in range(random.randint(*_RUNS_A_DAY)):
            if self.script.keeps(self._day, number):
                self._job(number)
        if killed_after_s is not None:
            self.happened["kill"] += 1
            plant.kill()
            self.keeper.restart(killed_after_s)
        self.keeper.deliver_all()
        self.witness.pulled(self.people.pull())
        self.witness.all_pulled(self.keeper.store)
        self.keeper.end()

    def _people_come(self) -> None:
        if self._first:
            self.people.begin()
        elif self.random.random() < _NEW_KEY:
            self.people.renew_key()
        self._first = False
        if self.random.random() < _STRANGER:
            self.happened["stranger"] += 1
            order = {"robot_serial": "SIM-1", "plan": "check", "operator": "nobody"}
            passed = self._last_pass(self.plant.serials[0])
            self.witness.without_right(self.people.try_without_right(order, passed))

    # One job -------------------------------------------------------------------------------------------

    def _job(self, number: int) -> None:
        """A client requests a run; a disturbance happens meanwhile; it ends, and the station is checked."""
        key = f"job {self._day}.{number}"
        self.random = Random(f"{self.seed} {key}")
        deed, trouble = _drawn(self.random, self.deeds), _drawn(self.random, self.troubles)
        if (self._day, number) in self.script.calm:
            trouble = "none"
        self.jobs.append(Job(self._day, number, deed, trouble))
        self.happened[deed] += 1
        if trouble != "none":
            self.happened[trouble] += 1
        request = self._request(deed, key)
        run = 0
        with self.keeper.answered():
            run = request.send(self.witness)
        if not run:
            self._rest()
            return
        helpers = [
            self.plant.scheduler.spawn(lambda: self._answer(run), "operator"),
            self.plant.scheduler.spawn(lambda: self._trouble(trouble, run, request, key), "trouble"),
            self.plant.scheduler.spawn(lambda: self._poll(run), "mes"),
        ]
        world = self.plant.scheduler
        ended = world.wait(lambda: self._is_over(run) and all(h.ended for h in helpers), RUN_LIMIT_S)
        self.plant.orders.replace(())
        self.plant.machine.remount(ROBOT.c)
        world.wait(seconds=self.random.choice((0.0, 0.0, 3.0)))
        self.plant.disk.mend()
        if not self.plant.runs:
            self._restart()
            with self.keeper.answered():  # a client without an answer to its start asks again
                request.send(self.witness)
        elif not ended:
            self.witness.fails("idle", f"run {run} ({deed}, {trouble}) does not end")
            raise Stranded
        elif trouble == "none":
            self.witness.undisturbed(run, self.keeper.store)
        self._rest()

    def _rest(self) -> None:
        if not self.plant.runs:
            self._restart()
        self.keeper.come_to_rest()

    def _restart(self) -> None:
        self.keeper.restart(self.random.uniform(1.0, 20.0))

    def _request(self, deed: str, key: str) -> Request:
        serial = self.plant.serials[self.plant.robot]
        people = self.people
        passed = self._last_pass(serial)
        if deed == "measure" or (deed != "retract" and passed is None):
            plan = _drawn(self.random, _PLANS)
            order: dict[str, object] = {"robot_serial": serial, "plan": plan, "operator": "Ada"}
            if plan == "adaptive":
                order["until_mm"] = 0.3
            client = self.random.choice((people.mes, people.operator))
            return Request(client, "/calibrations", order, "run.started", key)
        by = {"operator": "Ada"}
        if deed == "retract":
            return Request(people.operator, "/retract", by, "run.started", key)
        if deed == "apply":
            return Request(people.operator, f"/calibrations/{passed}/apply", by, "run.applied", key)
        return Request(people.operator, f"/calibrations/{passed}/rollback", by, "run.rolled_back", None)

    def _last_pass(self, serial: str) -> int | None:
        runs = self.keeper.store.calibrations(limit=10, robot_serial=serial, verdict="pass").items
        return next((run.id for run in runs if run.of is None and run.kind == "calibrate"), None)

    def _is_over(self, run: int) -> bool:
        runtime = self.plant.runtime
        return not self.plant.runs or (runtime is not None and runtime.orchestrator.running != run)

    # Simultaneous actions and disturbances ---------------------------------------------------------

    def _answer(self, run: int) -> None:
        """The operator answers the prompt of the run, or is absent."""
        world = self.plant.scheduler
        while not self._is_over(run):
            world.wait(seconds=self.random.uniform(1.0, 20.0))
            with self.keeper.answered():
                prompt = self.plant.ask(lambda station: station.prompt(run))
                if prompt is None or self.random.random() < 0.1:
                    continue
                value = None
                if prompt.kind == "number":
                    axis = self.plant.machine.axes[0]
                    value = axis.arm_deg(world.now_s) + self.random.gauss(0.0, 0.005)
                else:
                    back = "back" in prompt.text
                    self.plant.machine.remount(ROBOT.c if back else ROBOT.second_mount[1])
                said = {"prompt": prompt.id, "value": value}
                self.witness.answered(self.people.operator.send("POST", f"/calibrations/{run}/answer", said))

    def _poll(self, run: int) -> None:
        """The MES requests the progress of its run, and other events."""
        while not self._is_over(run):
            self.plant.scheduler.wait(lambda: self._is_over(run), self.random.uniform(5.0, 60.0))
            with self.keeper.answered():
                self.witness.answered(self.people.mes.send("GET", f"/calibrations/{run}"))
                self.witness.pulled(self.people.pull())

    def _abort(self, run: int) -> None:
        answer = self.people.operator.send("POST", f"/calibrations/{run}/abort")
        self.witness.answered(answer)
        if answer.status == 202:
            self.witness.done(self.people.operator.name, "run.aborted", f"run {run}")

    def _stop(self) -> None:
        pressed_s = self.plant.scheduler.now_s
        answer = self.people.operator.send("POST", "/stop")
        self.witness.answered(answer)
        if answer.status in (200, 502):
            self.witness.done(self.people.operator.name, "station.stopped", "both axes")
            self.witness.stopped(pressed_s, answer.body["axes"])

    def _trouble(self, trouble: str, run: int, request: Request, key: str) -> None:
        world, random = self.plant.scheduler, self.random
        world.wait(lambda: self._is_over(run), random.choice((0.0, 2.0, 15.0, 40.0)) * random.random())
        with self.keeper.answered():
            match trouble:
                case "abort":
                    over = self._is_over(run)
                    self._abort(run)
                    if not world.wait(lambda: over or self._is_over(run), ABORT_LIMIT_S):
                        self.witness.fails("idle", f"run {run} was aborted and goes on")
                case "stop":
                    self._stop()
                case "stop while a drive is silent":
                    device: Device = random.choice(("axis1", "axis2"))
                    self.plant.orders.replace([FaultOrder(device=device, kind="silent", for_s=3.0)])
                    world.wait(seconds=random.random())
                    self._stop()
                case "double start":
                    request.send(self.witness)
                case "second start":
                    if other := self._request("measure", f"{key} again").send(self.witness):
                        self.witness.second_start(run, other)
                case "kill" if self.plant.runs:
                    self.plant.kill()
                case "kill at a write":
                    at = self.plant.disk.writes + random.randrange(40)
                    world.wait(lambda: self._is_over(run) or self.plant.disk.writes > at)
                    if self.plant.runs:
                        self.plant.kill()
                case "disk":
                    kind: DiskTrouble = random.choice(("full", "error", "locked"))
                    self.plant.disk.fail(kind, after=random.randrange(30), times=random.choice((1, 3, 20)))
                case "disk, then kill":
                    self.plant.disk.fail("full", after=random.randrange(30), times=FOR_GOOD)
                    world.wait(lambda: self._is_over(run), ABORT_LIMIT_S)
                    if self.plant.runs:
                        self.plant.kill()
                case "clock":
                    self.plant.clocks.set_s += random.choice(_CLOCK_STEPS_S)
                case "device":
                    self._fault(run)
                case _:
                    pass

    def _fault(self, run: int) -> None:
        device: Device = self.random.choice(tuple(KINDS))
        kind = self.random.choice(KINDS[device])
        self.happened[f"{device} {kind}"] += 1
        if kind in _CHANGE_THE_MACHINE:
            self.witness.disturb(run)
        if kind == "jump":
            self.witness.jump(run)
        count = self.random.choice((1, 1, 3, None))
        for_s = self.random.choice((0.05, 0.5, 3.0)) if count is None else None
        self.plant.orders.replace([FaultOrder(device=device, kind=kind, count=count, for_s=for_s, mm=0.2)])


def _drawn(random: Random, weights: Mapping[T, float]) -> T:
    return random.choices(list(weights), list(weights.values()))[0]
