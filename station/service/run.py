"""One run while it lasts: its request, its cancel event, and what the page may see of it."""

from __future__ import annotations

import statistics
import time
from dataclasses import dataclass, field
from datetime import UTC, datetime
from threading import Event, Lock
from typing import Any

from station.five_bar import Robot
from station.records import CalibrationRequest, CalibrationResult, Reading, State, Walk

Place = tuple[float, float] | None


@dataclass
class Run:
    """Written by the worker, read by anybody; every view is a copy."""

    id: int
    request: CalibrationRequest
    robot: Robot
    cancel: Event = field(default_factory=Event)
    ended: Event = field(default_factory=Event)
    stopped_by: str | None = None
    state: State = State.QUEUED
    step: int = 0
    inherited: int = 0
    """Steps that an earlier run made."""
    steps: int = 0
    iterations: list[dict[str, Any]] = field(default_factory=list)
    _walk: Walk | None = None
    _stops: list[dict[str, Any]] = field(default_factory=list)
    _readings: list[dict[str, Any]] = field(default_factory=list)
    _started: float = field(default_factory=time.monotonic)
    _started_at: datetime = field(default_factory=lambda: datetime.now(UTC))
    _lock: Lock = field(default_factory=Lock)

    @property
    def has_moved(self) -> bool:
        """Whether a motion may have been commanded."""
        return self._walk is not None

    def inherit(self, steps: int) -> None:
        """Go on after the steps of an earlier run."""
        self.inherited = self.step = self.steps = steps

    def begin_walk(self, walk: Walk) -> dict[str, Any]:
        """Returns the `walk` event."""
        with self._lock:
            self._walk = walk
            self.steps += len(walk.stops)
            self._stops = [
                {
                    "position": stop.position,
                    "x_mm": stop.target_mm[0],
                    "y_mm": stop.target_mm[1],
                    "done": False,
                }
                for stop in walk.stops
            ]
            return {"number": walk.number, "title": walk.title, "stops": [dict(stop) for stop in self._stops]}

    def add_reading(self, index: int, reading: Reading, place: Place) -> dict[str, Any]:
        """Reading of the walk's stop `index`, already stored.  Returns the `reading` event."""
        row = {
            "reading": reading.reading,
            "position": reading.position,
            "x_mm": place and place[0],
            "y_mm": place and place[1],
            "theta1_deg": reading.theta_deg[0],
            "theta2_deg": reading.theta_deg[1],
            "scale_mm": reading.scale_mm,
            "sd_mm": statistics.stdev(reading.samples_mm),
            "residual_mm": None,
            "limit_mm": None,
            "t_s": reading.t_s,
            "walk": reading.walk,
        }
        with self._lock:
            self.step += 1
            self._stops[index]["done"] = True
            self._readings.append(row)
            return dict(row)

    def add_result(self, result: CalibrationResult) -> list[dict[str, Any]]:
        """Returns the `residuals` event."""
        residuals = {row["reading"]: row for row in result.residuals}
        with self._lock:
            self.iterations = [dict(row) for row in result.iterations]
            for row in self._readings:
                if found := residuals.get(row["reading"]):
                    row["residual_mm"], row["limit_mm"] = found["residual_mm"], found["limit_mm"]
            return [
                {key: row[key] for key in ("reading", "residual_mm", "limit_mm")} for row in self._readings
            ]

    def brief(self) -> dict[str, Any]:
        """The `run` event: without stops and readings."""
        with self._lock:
            return self._brief()

    def view(self) -> dict[str, Any]:
        """The `run` part of the snapshot."""
        with self._lock:
            return {
                **self._brief(),
                "stops": [dict(stop) for stop in self._stops],
                "readings": [dict(row) for row in self._readings],
            }

    def _brief(self) -> dict[str, Any]:
        elapsed_s = time.monotonic() - self._started
        walk = self._walk
        to_do = sum(not stop["done"] for stop in self._stops)
        return {
            "id": self.id,
            "state": str(self.state),
            "robot_serial": self.request.robot_serial,
            "plan": self.request.plan,
            "of": self.request.of,
            "operator": self.request.operator,
            "work_order": self.request.work_order,
            "started_at": self._started_at.isoformat(timespec="milliseconds").replace("+00:00", "Z"),
            "elapsed_s": round(elapsed_s, 1),
            "remaining_s": round(to_do * elapsed_s / own, 1) if (own := self.step - self.inherited) else None,
            "walk": {"number": walk.number, "title": walk.title} if walk else None,
            "step": self.step,
            "steps": self.steps,
            "iterations": [dict(row) for row in self.iterations],
        }
