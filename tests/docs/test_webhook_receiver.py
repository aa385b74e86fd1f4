"""The receiver of `connect-a-mes.md`, as a program of its own, takes what the station sends."""

from __future__ import annotations

import json
import socket
import subprocess
import sys
import time
from datetime import UTC, datetime
from pathlib import Path

import pytest

from station.outbox import Refused
from station.outbox.webhook import Webhook
from station.records import Event, uid7
from station.settings import WebhookSettings
from tests.docs.test_mes_job import LIMIT_S, block
from tests.station.outbox.test_receivers import SECRET


def test_the_receiver_keeps_each_event_once_and_refuses_forgeries(tmp_path: Path) -> None:
    (tmp_path / "receiver.py").write_text(block("webhook_receiver.py"), encoding="utf-8")
    (tmp_path / "webhook-secret").write_text(SECRET)
    (tmp_path / "forged").write_text("whsec_" + "A" * 40)
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = int(free.getsockname()[1])
    program = subprocess.Popen(
        [sys.executable, "receiver.py", str(port)], cwd=tmp_path, stderr=subprocess.DEVNULL
    )
    try:
        deadline_s = time.monotonic() + LIMIT_S
        with socket.socket() as probe:
            while probe.connect_ex(("127.0.0.1", port)) != 0:
                assert program.poll() is None and time.monotonic() < deadline_s
                time.sleep(0.02)
        url = f"http://127.0.0.1:{port}/station"
        ours = Webhook(WebhookSettings(url=url, secret_file=tmp_path / "webhook-secret"))
        events = [
            Event(n=n, uid=uid7(), type="run.ended", at=datetime.now(UTC), data={"id": n}) for n in (1, 2)
        ]
        for event in (events[0], events[1], events[0]):
            assert ours.deliver(event).startswith("204")
        with pytest.raises(Refused, match="401"):
            Webhook(WebhookSettings(url=url, secret_file=tmp_path / "forged")).deliver(events[0])
    finally:
        program.terminate()
        program.wait(LIMIT_S)
    kept = [json.loads(line) for line in (tmp_path / "events.jsonl").read_text().splitlines()]
    assert [(one["uid"], one["data"]["id"]) for one in kept] == [(e.uid, e.data["id"]) for e in events]
