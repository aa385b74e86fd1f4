"""Receivers written from the documentation: a web server with the public verification library, a broker."""

from __future__ import annotations

import base64
import csv
import json
import logging
import re
import shutil
import socket
import subprocess
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from http.server import BaseHTTPRequestHandler, HTTPServer
from pathlib import Path
from typing import Any

import paho.mqtt.client as mqtt
import pytest
from paho.mqtt.enums import CallbackAPIVersion
from pydantic import ValidationError
from standardwebhooks import Webhook as PublicWebhook

from station.cli.machine_options import logging_to
from station.errors import InputRefused
from station.outbox import Courier, Refused, couriers
from station.outbox.folder import Folder
from station.outbox.mqtt import EXPIRES_S, REPEAT_S, Mqtt
from station.outbox.webhook import Webhook
from station.records import Event, uid7
from station.settings import FolderSettings, MqttSettings, OutboxSettings, WebhookSettings
from station.store import Store

SECRET = "whsec_" + base64.b64encode(bytes(range(32))).decode()
EVENT = Event(
    n=7, uid=uid7(), type="run.ended", at=datetime(2026, 11, 27, tzinfo=UTC),
    data={"id": 3, "work_order": "=cmd()", "reason_params": {"by": "ada"}},
)  # fmt: skip
LIMIT_S = 10.0


@pytest.fixture
def secret_file(tmp_path: Path) -> Path:
    file = tmp_path / "secret"
    file.write_text(SECRET + "\n")
    return file


@contextmanager
def web_server(status: int) -> Iterator[tuple[str, list[Any]]]:
    """Verifies every request with the public library; its address and what it took."""
    taken: list[Any] = []

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            body = self.rfile.read(int(self.headers["Content-Length"]))
            headers = {key.lower(): value for key, value in self.headers.items()}
            taken.append((headers["webhook-id"], PublicWebhook(SECRET).verify(body, headers)))
            self.send_response(status)
            self.send_header("Content-Length", "0")
            self.end_headers()

        def log_message(self, *_: Any) -> None: ...

    with HTTPServer(("127.0.0.1", 0), Handler) as server:
        thread = threading.Thread(target=server.serve_forever, args=(0.01,))
        thread.start()
        try:
            yield f"http://127.0.0.1:{server.server_port}/hook?line=4", taken
        finally:
            server.shutdown()
            thread.join()


@pytest.mark.parametrize(
    ("status", "raised"),
    [(204, None), (410, Refused), (429, OSError), (408, OSError), (500, OSError), (302, OSError)],
)
def test_a_webhook_verifies_with_the_public_library(
    secret_file: Path, status: int, raised: type[Exception] | None
) -> None:
    with web_server(status) as (url, taken):
        webhook = Webhook(WebhookSettings(url=url, secret_file=secret_file))
        if raised is None:
            assert webhook.deliver(EVENT).startswith("204")
        else:
            with pytest.raises(raised, match=str(status)):
                webhook.deliver(EVENT)
        ((uid, body),) = taken
    assert uid == EVENT.uid
    assert body == {"type": "run.ended", "timestamp": "2026-11-27T00:00:00Z", "data": EVENT.data}


def test_a_webhook_without_a_good_secret_or_over_plain_http_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "secret"
    local = "http://localhost:1/"
    with pytest.raises(InputRefused, match="cannot be read"):
        Webhook(WebhookSettings(url=local, secret_file=file))
    for text, said in (("whsec_!", "base64"), ("whsec_QUJD", "24 or more")):
        file.write_text(text)
        with pytest.raises(InputRefused, match=said):
            Webhook(WebhookSettings(url=local, secret_file=file))
    with pytest.raises(ValidationError, match="plain http"):
        WebhookSettings(url="http://mes.example/", secret_file=file)


def test_a_token_in_an_address_is_sent_and_not_shown(
    store: Store, secret_file: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    with web_server(400) as (url, taken), logging_to(tmp_path / "home", terminal=logging.INFO):
        webhook = Webhook(WebhookSettings(url=f"{url}&sig=hush", secret_file=secret_file, events=("alarm",)))
        courier = Courier(store, webhook, OutboxSettings())
        courier.step()
        store.announce("alarm", {"text": "test"})
        courier.step()
    assert len(taken) == 1
    (delivery,) = store.deliveries()
    name = f"webhook {url.partition('?')[0]}"
    assert (delivery.receiver, delivery.state) == (name, "refused")
    log = (tmp_path / "home/station.log").read_text()
    assert f"{name} refuses event 1" in log
    assert "hush" not in log + capfd.readouterr().err


def test_two_receivers_of_one_name_are_refused(store: Store, secret_file: Path) -> None:
    """They would share a queue, and each would miss what the other takes."""
    hook = {"url": "https://mes.example/hook", "secret_file": secret_file}
    for twins, name in (
        ({"webhook": [hook, {**hook, "url": f"{hook['url']}?a=1"}]}, "webhook https://mes.example/hook;"),
        ({"mqtt": [{"url": f"mqtt://b:{port}", "topic": "t"} for port in (1, 2)]}, "mqtt t at b;"),
        ({"folder": [{"path": "f", "format": kind} for kind in ("csv", "json")]}, "folder f;"),
    ):
        settings = OutboxSettings.model_validate(twins)
        with (
            pytest.raises(InputRefused, match=f"2 receivers called {re.escape(name)}"),
            couriers(store, settings),
        ):
            pass


def test_a_folder_holds_one_file_an_event_however_often_it_comes(tmp_path: Path) -> None:
    for kind in ("json", "csv"):
        folder = Folder(FolderSettings(path=tmp_path / kind, format=kind))
        folder.deliver(EVENT), folder.deliver(EVENT)
        (file,) = (tmp_path / kind).iterdir()
        assert file.name == f"000000007-{EVENT.uid}.{kind}"
    assert json.loads((tmp_path / "json" / f"000000007-{EVENT.uid}.json").read_text())["n"] == 7
    with file.open() as lines:
        (row,) = csv.DictReader(lines)
    assert (row["event_uid"], row["work_order"]) == (EVENT.uid, "'=cmd()")


def free_port() -> int:
    with socket.socket() as sock:
        sock.bind(("127.0.0.1", 0))
        return int(sock.getsockname()[1])


@contextmanager
def broker(port: int, folder: Path, more: str = "allow_anonymous true\n") -> Iterator[None]:
    """A real mosquitto that listens on loopback alone."""
    program = shutil.which("mosquitto") or shutil.which("mosquitto", path="/usr/sbin")
    if program is None:
        pytest.skip("mosquitto is not installed")
    config = folder / "mosquitto.conf"
    config.write_text(f"listener {port} 127.0.0.1\n{more}")
    process = subprocess.Popen([program, "-c", str(config)], stderr=subprocess.DEVNULL)
    try:
        deadline = time.monotonic() + LIMIT_S
        while True:
            with socket.socket() as sock:
                if sock.connect_ex(("127.0.0.1", port)) == 0:
                    break
            assert time.monotonic() < deadline
            time.sleep(0.02)
        yield
    finally:
        process.terminate()
        process.wait()


class Listener:
    """Somebody who subscribes, as the documentation says."""

    def __init__(self, port: int) -> None:
        self.heard: list[tuple[str, str, str | None]] = []
        self.expiries: list[int | None] = []
        self._news, self._subscribed = threading.Condition(), threading.Event()
        self._client = mqtt.Client(CallbackAPIVersion.VERSION2, protocol=mqtt.MQTTv5)
        self._client.on_message = self._on_message
        self._client.on_subscribe = lambda *_: self._subscribed.set()
        self._client.connect("127.0.0.1", port)
        self._client.subscribe("plant/station/#", qos=1)
        self._client.loop_start()
        assert self._subscribed.wait(LIMIT_S)

    def _on_message(self, _client: Any, _data: Any, message: mqtt.MQTTMessage) -> None:
        ids = dict(getattr(message.properties, "UserProperty", []))
        with self._news:
            self.expiries.append(getattr(message.properties, "MessageExpiryInterval", None))
            self.heard.append(
                (message.topic.removeprefix("plant/station/"), message.payload.decode(), ids.get("id"))
            )
            self._news.notify_all()

    def wait(self, count: int) -> None:
        with self._news:
            assert self._news.wait_for(lambda: len(self.heard) >= count, LIMIT_S), self.heard

    def close(self) -> None:
        self._client.disconnect()
        self._client.loop_stop()


def test_a_broker_is_told_across_its_restart_and_knows_when_the_station_is_gone(tmp_path: Path) -> None:
    port = free_port()
    station = Mqtt(MqttSettings(url=f"mqtt://127.0.0.1:{port}", topic="plant/station"))
    with broker(port, tmp_path):
        station.report_running()
        listener = Listener(port)
        listener.wait(1)
        assert station.deliver(EVENT) == "acknowledged"
        listener.wait(2)
        listener.close()
        assert listener.heard[0][:2] == ("state", "online")
        topic, payload, uid = listener.heard[1]
        assert (topic, uid, json.loads(payload)["data"]) == ("events/run.ended", EVENT.uid, EVENT.data)
    with broker(port, tmp_path):
        listener = Listener(port)
        assert station.deliver(EVENT) == "acknowledged"
        listener.wait(2)
        assert sorted(name for name, _, _ in listener.heard) == ["events/run.ended", "state"]
        # cut off without a word: the broker sends the last will
        client = station._client
        assert client is not None
        client.socket().shutdown(socket.SHUT_RDWR)  # type: ignore[union-attr]
        listener.wait(3)
        assert listener.heard[2][:2] == ("state", "offline")
        listener.close()
        station.close()


def test_online_is_repeated_and_expires_and_offline_stays(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A station that dies while the broker is down leaves no last will, only an `online` that expires."""
    monkeypatch.setattr("station.outbox.mqtt.REPEAT_S", 0.0)
    port = free_port()
    station = Mqtt(MqttSettings(url=f"mqtt://127.0.0.1:{port}", topic="plant/station"))
    with broker(port, tmp_path):
        listener = Listener(port)
        station.report_running()
        listener.wait(1)
        station.report_running()
        listener.wait(2)
        station.close()
        listener.wait(3)
        listener.close()
    assert [payload for _, payload, _ in listener.heard] == ["online", "online", "offline"]
    *online, offline = listener.expiries
    assert all(seconds is not None and 0 < seconds <= EXPIRES_S for seconds in online)
    assert offline is None
    assert REPEAT_S < EXPIRES_S / 2


def test_an_event_that_the_broker_does_not_accept_is_not_delivered(tmp_path: Path) -> None:
    """MQTT 5 acknowledges it with a reason, for instance that the topic is not permitted."""
    (tmp_path / "acl").write_text("topic readwrite other/#\n")
    # started as root, it would become another user, who cannot read this folder: `user root`
    port = free_port()
    station = Mqtt(MqttSettings(url=f"mqtt://127.0.0.1:{port}", topic="plant/station"))
    with broker(port, tmp_path, f"user root\nallow_anonymous true\nacl_file {tmp_path / 'acl'}\n"):
        with pytest.raises(Refused, match="Not authorized"):
            station.deliver(EVENT)
        station.close()


def test_a_broker_that_lets_nobody_in_says_why(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("station.outbox.mqtt.TIMEOUT_S", 1.0)
    port = free_port()
    station = Mqtt(MqttSettings(url=f"mqtt://ada:wrong@127.0.0.1:{port}", topic="plant/station"))
    with broker(port, tmp_path, "allow_anonymous false\n"):
        with pytest.raises(OSError, match="refuses the connection: Not authorized"):
            station.deliver(EVENT)
        station.close()
