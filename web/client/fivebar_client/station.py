"""The interface of the station for a MES."""

from __future__ import annotations

import time
from collections.abc import Iterator
from types import TracebackType
from typing import Self

import httpx2 as httpx

from fivebar_client.asking import Asking, accepted, read
from fivebar_client.models import (
    Calibration,
    CalibrationBody,
    CalibrationList,
    CalibrationSummary,
    Event,
    EventList,
    ReadingAnswer,
    ReadingList,
    StationView,
    Stopped,
)

API = "/api/v1"
ENDED = ("succeeded", "failed", "aborted", "interrupted")
"""Final states."""
_ANSWER_S = 15.0
_NOT_CONFIRMED = 502


class Station:
    """One station.  Every method raises a `StationError` on failure.

    Requests are repeated while the station is unreachable or busy.
    """

    def __init__(
        self, url: str, key: str, *, patience_s: float = 60.0, http: httpx.Client | None = None
    ) -> None:
        """:param url: for instance `https://station.plant.example`
        :param key: made with `station key add NAME --role mes`
        :param patience_s: time limit for repetitions
        :param http: your own client, for instance one that trusts the plant's certificate authority
        """
        self._http = http or httpx.Client(timeout=_ANSWER_S)
        self._http.base_url = httpx.URL(f"{url.rstrip('/')}{API}")
        self._http.headers["Authorization"] = f"Bearer {key}"
        self._asking = Asking(self._http, patience_s)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Close the connections."""
        self._http.close()

    def view(self) -> StationView:
        """Current devices, interlocks and active run."""
        return self._asking.read(StationView, "GET", "/station")

    def start(self, body: CalibrationBody, idempotency_key: str) -> CalibrationSummary:
        """Start a run; the same key and body again returns the same run.

        :param idempotency_key: one for each new run, stored before this call
        :raises Refused: with `problem.type` `urn:station:problem:busy` if another run held the rig all the
        time, `...:key-reused` if the key was used for another request
        """
        return self._asking.read(
            CalibrationSummary,
            "POST",
            "/calibrations",
            content=body.model_dump_json(exclude_none=True),
            headers={"Idempotency-Key": idempotency_key, "Content-Type": "application/json"},
        )

    def run(self, number: int) -> Calibration:
        """One run in full."""
        return self._asking.read(Calibration, "GET", f"/calibrations/{number}")

    def runs(self, **filters: str) -> Iterator[CalibrationSummary]:
        """Runs, newest first.

        :param filters: as `work_order`, `robot_serial`, `state`, `verdict`, `plan`, `since`, `ended_since`
        """
        cursor: dict[str, int] = {}
        while True:
            page = self._asking.read(
                CalibrationList, "GET", "/calibrations", params={**filters, **cursor, "limit": 100}
            )
            yield from page.items
            if page.next is None:
                return
            cursor = {"cursor": page.next}

    def readings(self, number: int) -> list[ReadingAnswer]:
        """Readings of a run so far."""
        return self._asking.read(ReadingList, "GET", f"/calibrations/{number}/readings").items

    def certificate(self, number: int) -> bytes:
        """The certificate of a run as PDF.  :raises Refused: it has none."""
        return self._asking.ask("GET", f"/calibrations/{number}/certificate.pdf").content

    def wait(self, number: int, *, every_s: float = 1.0) -> Calibration:
        """The run after its end; also across restarts of the station."""
        while (run := self.run(number)).state not in ENDED:
            time.sleep(every_s)
        return run

    def events(self, after: int = 0) -> Iterator[Event]:
        """Events after event `after`, until now."""
        while True:
            page = self._asking.read(EventList, "GET", "/events", params={"after": after})
            yield from page.items
            if page.next is None:
                return
            after = page.next

    def abort(self, number: int) -> CalibrationSummary:
        """End a run that was started with the same key; repeating it is harmless."""
        return self._asking.read(CalibrationSummary, "POST", f"/calibrations/{number}/abort")

    def stop(self) -> Stopped:
        """Stop both axes now; sent once. `confirmed` states whether both stopped. Not the emergency stop."""
        answer = self._asking.once("POST", "/stop")
        return read(Stopped, answer if answer.status_code == _NOT_CONFIRMED else accepted(answer))
