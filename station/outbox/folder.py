"""A folder in which each event becomes a file, for programs that read files."""

from __future__ import annotations

import os
from pathlib import Path

from pydantic_core import to_json

from station.outbox.receiver import Refused
from station.records import Event, csv_text
from station.settings import FolderSettings


class Folder:
    """Files are named by number and uid: an existing file of the same name is the same event.

    Files are written atomically.
    """

    def __init__(self, settings: FolderSettings) -> None:
        self.name = f"folder {settings.path}"
        self.events: tuple[str, ...] = settings.events
        self._folder, self._format = settings.path, settings.format

    def report_running(self) -> None:
        """Nothing to do."""

    def deliver(self, event: Event) -> str:
        """As `Receiver.deliver`."""
        self._folder.mkdir(parents=True, exist_ok=True)
        file = self._folder / f"{event.n:09d}-{event.uid}.{self._format}"
        unfinished = file.with_suffix(".part")
        text = to_json(event) if self._format == "json" else _as_csv(event).encode()
        with unfinished.open("wb") as out:
            out.write(text)
            out.flush()
            os.fsync(out.fileno())
        unfinished.replace(file)
        _keep(self._folder)
        return file.name

    def close(self) -> None:
        """Nothing to close."""


def _keep(folder: Path) -> None:
    """Sync the folder: the name of a new file is on the disk only after that."""
    handle = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def _as_csv(event: Event) -> str:
    """One row: the event and the flat fields of its data; the others as JSON."""
    flat = {
        key: value if isinstance(value, str | int | float | None) else to_json(value).decode()
        for key, value in event.data.items()
    }
    columns = {"n": event.n, "event_uid": event.uid, "type": event.type, "at": event.at.isoformat(), **flat}
    if len(columns) != len(flat) + 4:
        raise Refused("its data has a field n, event_uid, type or at")
    return csv_text([*columns], [[*columns.values()]])
