"""Robot files by version, and the data that passed runs leave to a robot's next one."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Mapping
from dataclasses import replace
from datetime import UTC, datetime
from typing import Protocol

from sqlite_utils import Database

from station.errors import NotApplicable, NotFound
from station.five_bar import FIVE_BAR_MODEL, Robot
from station.records import Actor, KeptRobot, LastingParameters, Remembered, Sections
from station.store.audit import AuditTrail
from station.store.rows import compact, moment
from station.store.times import now_ms

MOST_OF_TYPE = 50
"""Maximum number of robots for the prior of a further one: more make no difference."""


class RobotFile(Protocol):
    """A robot file for any kind of machine."""

    @property
    def serial(self) -> str:
        """Serial of the robot."""
        ...

    def to_json(self) -> Sections:
        """The sections of its file."""
        ...


class RobotFiles(AuditTrail):
    """A changed robot file is a new version; a run refers to the version it was made with."""

    def save_robot(self, robot: RobotFile) -> int:
        """Store a robot file; a changed one becomes a new version.  Returns the version's row id.

        :raises NotApplicable: the serial is that of another kind of machine, or robots of its type have other
            nominal lengths.
        """
        file = compact(robot.to_json())
        with self._writing() as db:
            row = db.execute(
                "SELECT id, file FROM robots WHERE serial = ? ORDER BY id DESC LIMIT 1", [robot.serial]
            ).fetchone()
            if row is not None and row[1] == file:
                return int(row[0])
            if row is not None and (own := _model(json.loads(row[1]))) != _model(robot.to_json()):
                raise NotApplicable(
                    f"Robot {robot.serial} is kept as a machine of model {own}; "
                    "give another kind of machine another serial number."
                )
            _check_type(db, robot)
            cursor = db.execute(
                "INSERT INTO robots (serial, file, saved_ms) VALUES (?, ?, ?)",
                [robot.serial, file, now_ms()],
            )
            return int(cursor.lastrowid or 0)

    def change_robot(self, by: Actor, robot: RobotFile) -> None:
        """Store a robot file that a person supplied."""
        before = self._readers.one(
            "SELECT file FROM robots WHERE serial = ? ORDER BY id DESC LIMIT 1", [robot.serial]
        )
        with self._writing():
            self.save_robot(robot)
            known = json.loads(before["file"]) if before else None
            after = json.loads(compact(robot.to_json()))
            self.record(by, "robot.changed", f"robot {robot.serial}", before=known, after=after)

    def robot_file(self, serial: str) -> Sections:
        """The latest version of the file of a robot of any kind.  :raises NotFound:"""
        row = self._readers.one("SELECT file FROM robots WHERE serial = ? ORDER BY id DESC LIMIT 1", [serial])
        if row is None:
            raise NotFound(f"Robot {serial} is not known here.")
        return _sections(row["file"])

    def robot(self, serial: str) -> Robot:
        """The latest version of a five-bar's file.  :raises NotFound: :raises NotApplicable:"""
        return _five_bar(self.robot_file(serial), f"robot {serial}")

    def robot_or_nominal(self, serial: str) -> Robot:
        """The same, or the paper's Table 1 for a robot without a stored file."""
        try:
            return self.robot(serial)
        except NotFound:
            return Robot.default(serial)

    def robots(self, after: str = "", limit: int | None = None) -> list[KeptRobot]:
        """The latest version of each, by serial.

        :param after: only serials after this one
        :param limit: number of robots; None is all
        """
        rows = self._readers.all(
            "SELECT serial, file, saved_ms FROM robots"
            " WHERE id IN (SELECT max(id) FROM robots GROUP BY serial) AND serial > ?"
            " ORDER BY serial LIMIT ?",
            [after, -1 if limit is None else limit],
        )
        return [
            KeptRobot(serial=row["serial"], saved_at=moment(row["saved_ms"]), file=json.loads(row["file"]))
            for row in rows
        ]

    def robot_file_of(self, calibration_id: int) -> Sections:
        """The robot file of any kind with which the calibration was made. :raises NotFound:"""
        row = self._readers.one(
            "SELECT file FROM robots WHERE id = (SELECT robot_id FROM calibrations WHERE id = ?)",
            [calibration_id],
        )
        if row is None:
            raise NotFound(f"There is no calibration {calibration_id}.")
        return _sections(row["file"])

    def robot_of(self, calibration_id: int) -> Robot:
        """The same for a five-bar. :raises NotFound: :raises NotApplicable:"""
        return _five_bar(self.robot_file_of(calibration_id), f"robot of calibration {calibration_id}")


class Memories(RobotFiles):
    """Geometry and mechanism found by passed runs; the newest that was not cleared counts."""

    def memory(self, serial: str, as_of: datetime | None = None) -> Remembered | None:
        """The memory for the robot's next run: from its newest pass, not cleared, with the same robot file.

        :param as_of: start of the run, from which the age is counted; None is now
        """
        row = self._readers.one(
            "SELECT calibration_id, at_ms, memory, robot_id, cleared_ms FROM memories"
            " JOIN calibrations ON id = calibration_id WHERE memories.robot_serial = ?"
            " ORDER BY calibration_id DESC LIMIT 1",
            [serial],
        )
        latest = self._readers.one("SELECT max(id) AS id FROM robots WHERE serial = ?", [serial])
        if row is None or latest is None or row["cleared_ms"] is not None or row["robot_id"] != latest["id"]:
            return None
        return replace(_remembered(row), as_of=as_of)

    def memory_left_by(self, calibration_id: int) -> Remembered:
        """The data that one run left to the next, cleared or not. :raises NotFound:"""
        row = self._readers.one(
            "SELECT calibration_id, at_ms, memory FROM memories WHERE calibration_id = ?", [calibration_id]
        )
        if row is None:
            raise NotFound(f"Run {calibration_id} left no memory.")
        return _remembered(row)

    def others_of_type(self, robot: Robot) -> list[tuple[Robot, LastingParameters]]:
        """Other robots of its type with the memory of their newest pass, newest first; none cleared."""
        rows = self._readers.all(
            "SELECT memories.robot_serial, memory, file FROM memories"
            " JOIN calibrations ON calibrations.id = calibration_id JOIN robots ON robots.id = robot_id"
            " WHERE calibration_id IN (SELECT max(calibration_id) FROM memories GROUP BY robot_serial)"
            " AND cleared_ms IS NULL AND memories.robot_serial != ?"
            " AND json_extract(file, '$.robot.type') = ?"
            " ORDER BY calibration_id DESC LIMIT ?",
            [robot.serial, robot.type, MOST_OF_TYPE],
        )
        return [
            (
                _five_bar(_sections(row["file"]), f"robot {row['robot_serial']}"),
                LastingParameters.model_validate_json(row["memory"]),
            )
            for row in rows
            if _lengths(_sections(row["file"])) == _lengths(json.loads(compact(robot.to_json())))
        ]

    def forget(self, serial: str, by: Actor) -> None:
        """The robot's next run starts without memory; the old memory remains stored.

        Repeating it is harmless. :raises NotFound: no such robot.
        """
        self.robot(serial)
        with self._writing() as db:
            cleared = db.execute(
                "UPDATE memories SET cleared_ms = ?, cleared_by = ?"
                " WHERE robot_serial = ? AND cleared_ms IS NULL",
                [now_ms(), by.name, serial],
            ).rowcount
            self.record(by, "memory.cleared", f"robot {serial}", before={"memories": cleared})


def _check_type(db: Database, robot: RobotFile) -> None:
    """:raises NotApplicable: robots of its type have other nominal lengths; with the remedy."""
    file: Sections = json.loads(compact(robot.to_json()))
    kind = _robot_section(file).get("type")
    if kind is None:
        return
    rows = db.execute(
        "SELECT serial, file FROM robots WHERE id IN (SELECT max(id) FROM robots GROUP BY serial)"
        " AND serial != ? AND json_extract(file, '$.robot.type') = ? ORDER BY id DESC LIMIT 1",
        [robot.serial, kind],
    )
    for row in rows:
        if _lengths(json.loads(row[1])) != _lengths(file):
            raise NotApplicable(
                f"Robot {robot.serial} is said to be of type {kind}, but robot {row[0]} of that type has "
                "other nominal lengths; correct e, L and l or give it another type."
            )


def _lengths(file: Sections) -> tuple[object, ...]:
    """Nominal geometry of a robot."""
    section = _robot_section(file)
    return tuple(section.get(key) for key in ("e", "L", "l"))


def _robot_section(file: Sections) -> Mapping[str, object]:
    section = file.get("robot")
    return section if isinstance(section, dict) else {}


def _sections(text: str) -> Sections:
    sections: Sections = json.loads(text)
    return sections


def type_of(file: Sections) -> str | None:
    """The type designation in a robot file; None where it has none."""
    section = file.get("robot")
    named = section.get("type") if isinstance(section, dict) else None
    return None if named is None else str(named)


def _model(file: Sections) -> str:
    section = file.get("robot")
    return str(section.get("model", FIVE_BAR_MODEL)) if isinstance(section, dict) else FIVE_BAR_MODEL


def _five_bar(file: Sections, source: str) -> Robot:
    model = _model(file)
    if model != FIVE_BAR_MODEL:
        raise NotApplicable(
            f"The {source} is a machine of model {model}. Its logs can be imported and diagnosed; "
            "measuring, applying and solving are for five-bars."
        )
    return Robot.from_dict(file, source=source)


def _remembered(row: sqlite3.Row) -> Remembered:
    at = datetime.fromtimestamp(row["at_ms"] / 1000, UTC)
    return Remembered(row["calibration_id"], at, LastingParameters.model_validate_json(row["memory"]))
