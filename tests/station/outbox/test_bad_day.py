"""A day with a receiver that answers 500, hangs, dies in mid-answer or is not there, on a simulated clock."""

from __future__ import annotations

import itertools
import random
import socket
import threading
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

import pytest
from standardwebhooks import Webhook as PublicWebhook

from station.outbox import Courier
from station.outbox.webhook import Webhook
from station.settings import OutboxSettings, WebhookSettings
from station.store.store import Store
from tests.station.outbox.test_courier import Clock
from tests.station.outbox.test_receivers import LIMIT_S, SECRET, secret_file

__all__ = ["secret_file"]
HOURS, TRIES_AN_HOUR = 24, 3
GOOD = "HTTP/1.1 204 No Content\r\nContent-Length: 0\r\n\r\n"
ANSWERS = {
    "500": "HTTP/1.1 500 Internal Server Error\r\nContent-Length: 0\r\n\r\n",
    "dies before it answers": "",
    "dies in mid-answer": "HTTP/1.1 20",
    "dies in mid-header": "HTTP/1.1 200 OK\r\nContent-Le",
    "dies in mid-body": "HTTP/1.1 200 OK\r\nContent-Length: 9\r\n\r\n{",
    "hangs": None,
}


class Receiver:
    """Takes events over a real socket; how it ends each is ordered from outside."""

    def __init__(self) -> None:
        self.mood = "500"
        self.took: list[tuple[str, str]] = []
        """Event and mood, in the order of arrival."""
        self.listener = socket.create_server(("127.0.0.1", 0))
        self._hanging: list[socket.socket] = []
        self._thread = threading.Thread(target=self._serve)
        self._thread.start()

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self.listener.getsockname()[1]}/"

    def close(self) -> None:
        self.listener.shutdown(socket.SHUT_RDWR)
        self._thread.join()
        self.listener.close()
        for one in self._hanging:
            one.close()

    def _serve(self) -> None:
        while True:
            try:
                connection, _ = self.listener.accept()
            except OSError:
                return
            if not self._take(connection):
                connection.close()

    def _take(self, connection: socket.socket) -> bool:
        """Whether it is left hanging."""
        with connection.makefile("rb") as stream:
            stream.readline()
            lines = iter(lambda: stream.readline().decode().strip(), "")
            headers = {name.lower(): value for name, value in (line.split(": ", 1) for line in lines)}
            body = stream.read(int(headers["content-length"]))
        PublicWebhook(SECRET).verify(body, headers)
        self.took.append((headers["webhook-id"], self.mood))
        answer = ANSWERS.get(self.mood, GOOD)
        if answer is None:
            self._hanging.append(connection)
            return True
        connection.sendall(answer.encode())
        return False


@contextmanager
def receiving() -> Iterator[Receiver]:
    receiver = Receiver()
    try:
        yield receiver
    finally:
        receiver.close()


def test_a_day_without_the_receiver_loses_nothing_and_keeps_the_order(
    tmp_path: Path, secret_file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Events come all day, every hour another courier on the history opened anew; then it is well again."""
    clock, draw = Clock(), random.Random(7)
    moods = itertools.cycle(ANSWERS)
    with receiving() as receiver:
        webhook = Webhook(WebhookSettings(url=receiver.url, secret_file=secret_file, events=("alarm",)))
        with closing(Store(tmp_path / "station.db")) as store:
            store.enqueue(webhook.name, webhook.events)
        for hour in range(HOURS):
            with closing(Store(tmp_path / "station.db")) as store:
                on_the_way = Courier(store, webhook, OutboxSettings(), clock)
                store.announce("alarm", {"hour": hour})
                for _ in range(TRIES_AN_HOUR):
                    receiver.mood = next(moods)
                    limit_s = 0.02 if receiver.mood == "hangs" else LIMIT_S
                    monkeypatch.setattr("station.outbox.webhook.TIMEOUT_S", limit_s)
                    on_the_way.step()
                    monkeypatch.setattr("station.outbox.webhook.TIMEOUT_S", LIMIT_S)
                    clock.wait(3600.0 / TRIES_AN_HOUR * draw.uniform(0.9, 1.1))
                assert {d.state for d in store.deliveries()} == {"waiting"}
                assert len({uid for uid, _ in receiver.took}) == 1, "nothing overtakes the first"
        with closing(Store(tmp_path / "station.db")) as store:
            on_the_way = Courier(store, webhook, OutboxSettings(), clock)
            receiver.mood = "dies before it answers"
            on_the_way.step()
            clock.wait(61.0)
            receiver.mood = "well"
            for _ in range(HOURS):
                on_the_way.step()
            told = [event.uid for event in store.happenings(limit=500)]
            assert {d.state for d in store.deliveries(limit=500)} == {"delivered"}
    well = [uid for uid, mood in receiver.took if mood == "well"]
    assert well == told and len(told) == HOURS, "all, in order, once each after it was well"
    assert len(receiver.took) == HOURS * TRIES_AN_HOUR + 1 + HOURS
    assert {mood for _, mood in receiver.took} == {*ANSWERS, "well"}


def test_a_receiver_that_is_not_there_is_tried_again(store: Store, secret_file: Path) -> None:
    with socket.socket() as nobody:
        nobody.bind(("127.0.0.1", 0))
        url = f"http://127.0.0.1:{nobody.getsockname()[1]}/"
        webhook = Webhook(WebhookSettings(url=url, secret_file=secret_file))
        store.enqueue(webhook.name, webhook.events)
        store.announce("alarm", {})
        Courier(store, webhook, OutboxSettings(), Clock()).step()
    (waiting,) = store.deliveries()
    said = "nothing accepts connections there"
    assert (waiting.state, waiting.tries, waiting.detail) == ("waiting", 1, said)
