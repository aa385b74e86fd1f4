"""The station as a MES sees it."""

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
"""States that do not change any more."""
_ANSWER_S = 15.0
_NOT_CONFIRMED = 502


class Station:
    """One station.  Every method raises a `StationError` where it fails.

    While the station cannot be reached, or answers that it is busy, requests are repeated.
    """

    def __init__(
        self, url: str, key: str, *, patience_s: float = 60.0, http: httpx.Client | None = None
    ) -> None:
        """
        :param url: as `https://station.plant.example`
        :param key: of `station key add NAME --role mes`
        :param patience_s: for so long
        :param http: a client of your own, for instance one that trusts the plant's certificate authority
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
        """Devices, interlocks and the run under way, at this moment."""
        return self._asking.read(StationView, "GET", "/station")

    def start(self, body: CalibrationBody, idempotency_key: str) -> CalibrationSummary:
        """Start a run; again with the same key and body answers the run that was started.

        :param idempotency_key: one for each run that is wanted, kept before this is called
        :raises Refused: with `problem.type` `urn:station:problem:busy` where another run held the rig all
            the time, `...:key-reused` where the key has started something else
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
        """Newest first.

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
        """What a run has measured so far."""
        return self._asking.read(ReadingList, "GET", f"/calibrations/{number}/readings").items

    def certificate(self, number: int) -> bytes:
        """The certificate of a run as PDF.  :raises Refused: it has none."""
        return self._asking.ask("GET", f"/calibrations/{number}/certificate.pdf").content

    def wait(self, number: int, *, every_s: float = 1.0) -> Calibration:
        """The run when it has ended; also across restarts of the station."""
        while (run := self.run(number)).state not in ENDED:
            time.sleep(every_s)
        return run

    def events(self, after: int = 0) -> Iterator[Event]:
        """What happened after event `after`, until now."""
        while True:
            page = self._asking.read(EventList, "GET", "/events", params={"after": after})
            yield from page.items
            if page.next is None:
                return
            after = page.next

    def abort(self, number: int) -> CalibrationSummary:
        """End a run that was started with the same key; again is harmless."""
        return self._asking.read(CalibrationSummary, "POST", f"/calibrations/{number}/abort")

    def stop(self) -> Stopped:
        """Stop both axes now, asked once.  `confirmed` says whether both did.  Not the emergency stop."""
        answer = self._asking.once("POST", "/stop")
        return read(Stopped, answer if answer.status_code == _NOT_CONFIRMED else accepted(answer))
