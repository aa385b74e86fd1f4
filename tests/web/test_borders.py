"""Rebinding, foreign pages and undeclared proxies are refused, and nothing moves."""

from __future__ import annotations

import socket
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient
from starlette.websockets import WebSocketDisconnect

from station.errors import InputRefused
from station.settings import load_settings
from tests.station.conftest import SETTINGS
from tests.web.conftest import BODY, LIMIT_S, Service, a_service, listening
from web.app import access_of, create_app
from web.headers import POLICIES

RUNS = "/api/v1/calibrations"
PROXIED = SETTINGS.model_validate(
    {**SETTINGS.model_dump(), "service": {"hosts": ["plant.example"], "trusted_proxies": ["192.0.2.0/24"]}}
)


def none_moved(service: Service) -> bool:
    return not [call for call in service.rig.script.calls if "move" in call]


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:8000", "station.evil.example", "a@station", ""]
)
def test_a_name_that_is_not_ours_is_refused(service: Service, host: str) -> None:
    for method, path in (("GET", "/"), ("GET", "/api/v1/station"), ("POST", RUNS), ("POST", "/api/v1/stop")):
        answer = service.client.request(method, path, headers={"Host": host})
        assert answer.status_code == 403 and answer.json()["type"].endswith("foreign-host")
    with (
        pytest.raises(WebSocketDisconnect),
        service.client.websocket_connect("/api/v1/live", headers={"Host": host}),
    ):
        pass
    assert none_moved(service)


@pytest.mark.parametrize("host", ["127.0.0.1:8000", "localhost", "[::1]:8000", "STATION"])
def test_the_station_knows_its_own_names(service: Service, host: str) -> None:
    assert service.client.get("/api/v1/station", headers={"Host": host}).status_code == 200


@pytest.mark.parametrize(
    "headers",
    [
        {"Origin": "http://evil.example"},
        {"Origin": "http://station:9999"},
        {"Origin": "http://station.evil.example"},
        {"Origin": "null"},
        {"Origin": "file://station"},
        {"Sec-Fetch-Site": "cross-site"},
        {"Sec-Fetch-Site": "same-site"},
        {"Origin": "http://evil.example", "Content-Type": "application/x-www-form-urlencoded"},
        {"Origin": "http://evil.example", "Content-Type": "text/plain"},
    ],
)
def test_a_foreign_page_commands_nothing(service: Service, headers: dict[str, str]) -> None:
    for path in (RUNS, "/api/v1/retract", "/api/v1/stop", "/api/v1/session"):
        answer = service.client.post(path, content=b'{"operator": "eve"}', headers=headers)
        assert answer.status_code == 403 and answer.json()["type"].endswith("foreign-origin")
    with (
        pytest.raises(WebSocketDisconnect),
        service.client.websocket_connect("/api/v1/live", headers=headers),
    ):
        pass
    assert none_moved(service) and service.runtime.orchestrator.running is None


def test_two_origins_are_none_of_ours(service: Service) -> None:
    headers = [("Origin", "http://station"), ("Origin", "http://evil.example")]
    for sent in (headers, headers[::-1]):
        answer = service.client.post("/api/v1/stop", headers=sent)
        assert answer.status_code == 403 and answer.json()["type"].endswith("foreign-origin")


def test_a_request_whose_end_is_ambiguous_hides_no_other(service: Service) -> None:
    hidden = b"POST /api/v1/stop HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 0\r\n\r\n"
    head = b"POST /api/v1/session HTTP/1.1\r\nHost: 127.0.0.1\r\nTransfer-Encoding: chunked\r\n"
    sent = head + f"Content-Length: {len(hidden) + 5}\r\n\r\n0\r\n\r\n".encode() + hidden
    with (
        listening(create_app(service.runtime)) as port,
        socket.create_connection(("127.0.0.1", port), LIMIT_S) as to,
    ):
        to.sendall(sent)
        answers = b"".join(iter(lambda: to.recv(65_536), b""))
    assert answers.count(b"HTTP/1.1") == 1 and answers.startswith(b"HTTP/1.1 400 ")
    assert b"either Content-Length or Transfer-Encoding" in answers
    assert not [call for call in service.rig.script.calls if "stop" in call]


def test_a_form_is_no_start(service: Service) -> None:
    answer = service.client.post(RUNS, data={**BODY})
    assert answer.status_code == 422 and none_moved(service)


def test_a_declared_proxy_may_rewrite_host_and_tells_who_asks(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with a_service(tmp_path, monkeypatch, PROXIED) as service:
        app = service.client.app

        def ask(peer: str, **headers: str) -> Any:
            client = TestClient(app, base_url="http://station", client=(peer, 5000))
            named = {name.replace("_", "-"): value for name, value in headers.items()}
            return client.post(RUNS, json={**BODY, "plan": "none"}, headers=named)

        page = "https://plant.example"
        reaches = 422  # the route itself, which knows no such plan
        assert ask("192.0.2.7", Origin=page).status_code == reaches
        assert ask("192.0.2.7", Origin=page, X_Forwarded_Host="plant.example").status_code == reaches
        assert ask("192.0.2.7", Origin=page, X_Forwarded_Host="evil.example").status_code == 403
        assert ask("192.0.2.7", Origin="https://evil.example").status_code == 403
        assert ask("198.51.100.1", X_Forwarded_Host="plant.example", Host="evil.example").status_code == 403


def test_a_secure_cookie_behind_a_proxy_that_speaks_tls(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with a_service(tmp_path, monkeypatch, PROXIED) as service:
        client = TestClient(service.client.app, base_url="http://station", client=("192.0.2.7", 5000))
        secret = {"secret": "x", "name": "Ada", "password": "correct horse"}
        access = access_of(service.runtime, "192.0.2.1")
        secret["secret"] = access.offer_first_administrator() or ""
        service.client.app.state.access = access  # type: ignore[attr-defined]
        answer = client.post("/api/v1/session/first", json=secret, headers={"X-Forwarded-Proto": "https"})
        assert answer.status_code == 201 and "secure" in answer.headers["set-cookie"].lower()


def test_only_the_emulated_rig_on_loopback_is_open(service: Service) -> None:
    for host, open in (("127.0.0.1", True), ("localhost", True), ("0.0.0.0", False), ("192.0.2.1", False)):
        assert access_of(service.runtime, host).open is open
    assert create_app(service.runtime, access=access_of(service.runtime, "0.0.0.0"))


def test_every_answer_carries_the_policies(closed: Service) -> None:
    for path in ("/", "/api/v1/station", "/nothing", "/healthz", "/openapi.json"):
        for headers in ({}, {"Host": "evil.example"}):
            answer = closed.client.get(path, headers=headers)
            assert not [name for name in POLICIES if name not in answer.headers], path


def test_settings_that_nobody_knows_are_refused(tmp_path: Path) -> None:
    file = tmp_path / "station.toml"
    for text, said in (
        ('[service]\napi_keys = "keys"', "api_keys is not an option"),
        ("[service]\nhosts = ['*']", "hosts"),
        ("[service]\ntrusted_proxies = ['everybody']", "trusted_proxies"),
        ("[outbox]\nwebhooks = []", "webhooks is not an option"),
        ("[[outbox.webhook]]\nurl = 'http://mes.example/'\nsecret_file = 's'", "plain http"),
    ):
        file.write_text(text)
        with pytest.raises(InputRefused, match=said):
            load_settings(file)
