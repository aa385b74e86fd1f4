"""Keys, sessions, open mode and the panel's stop, over HTTP."""

from __future__ import annotations

from contextlib import ExitStack
from datetime import UTC, datetime, timedelta
from typing import Any
from unittest.mock import Mock

import pytest
from fastapi.testclient import TestClient
from starlette.websockets import WebSocketDisconnect

from station.people import access, hashed_password, hashed_pin, secret_hash
from station.records import Actor
from station.store import Store
from tests.web.conftest import LIMIT_S, Service
from web.cookies import COOKIE, HOST_COOKIE
from web.guarded import UNATTENDED
from web.routes import live

ROOT = Actor(name="root", via="terminal")
SESSION = "/api/v1/session"
PASSWORD = "correct horse"
HASHED = hashed_password(PASSWORD)  # once: it costs what it is meant to cost


def refusal(answer: Any) -> tuple[int, str]:
    problem = answer.json()
    assert problem["type"] == "urn:station:problem:not-signed-in"
    assert answer.headers["www-authenticate"].startswith("Bearer")
    return answer.status_code, problem["detail"]


@pytest.fixture
def ada(closed: Service) -> Service:
    """A station where Ada is an operator."""
    closed.runtime.store.add_user(ROOT, "Ada", "operator", password_hash=HASHED)
    return closed


def test_who_signs_in_takes_the_place_of_who_was_there(ada: Service) -> None:
    sign_in(ada)
    earlier = ada.client.cookies[COOKIE]
    assert sign_in(ada).status_code == 201
    ada.client.cookies.clear()
    ada.client.cookies.set(COOKIE, earlier)
    assert "has ended" in refusal(ada.client.get(SESSION))[1]


def sign_in(service: Service, name: str = "ada", password: str = PASSWORD) -> Any:
    return service.client.post(SESSION, json={"name": name, "password": password})


def test_every_reason_why_a_key_opens_nothing(closed: Service) -> None:
    def asked(headers: dict[str, str]) -> Any:
        return closed.client.get("/api/v1/station", headers=headers)

    assert "Authorization: Bearer KEY" in refusal(asked({}))[1]
    assert "not known here" in refusal(asked({"Authorization": "Bearer fbs_stolen-and-wrong"}))[1]
    assert "must be `Bearer KEY`" in refusal(asked({"Authorization": "Basic YWRhOmFkYQ=="}))[1]
    good = closed.key("viewer", "line 4")
    assert asked(good).status_code == 200
    closed.runtime.store.revoke_key(ROOT, "line 4")
    assert "was revoked at" in refusal(asked(good))[1]
    late = closed.key("viewer", "old", expires_at=datetime.now(UTC) - timedelta(seconds=1))
    assert "expired at" in refusal(asked(late))[1]


def test_another_process_changes_what_holds_at_once(closed: Service) -> None:
    """As the command line does: a store of its own on the same file."""
    with ExitStack() as opened:
        other = Store(closed.runtime.store.path)
        opened.callback(other.close)
        other.add_key(ROOT, "line 4", "viewer", secret_hash("fbs_1"), None)
        headers = {"Authorization": "Bearer fbs_1"}
        assert closed.client.get("/api/v1/station", headers=headers).status_code == 200
        other.revoke_key(ROOT, "line 4")
        assert closed.client.get("/api/v1/station", headers=headers).status_code == 401


def test_signing_in_and_out(ada: Service) -> None:
    assert ada.client.get(SESSION).status_code == 401
    answer = sign_in(ada)
    assert answer.status_code == 201
    assert answer.json() == {
        "name": "Ada", "role": "operator", "via": "user", "signs_off_after_s": 3600.0, "sign_out_at": None,
    }  # fmt: skip
    cookie = answer.headers["set-cookie"].lower()
    assert "httponly" in cookie and "samesite=strict" in cookie and "path=/" in cookie
    assert ada.client.get(SESSION).json()["name"] == "Ada"
    assert ada.client.get("/api/v1/station").status_code == 200
    assert ada.client.delete(SESSION).status_code == 204
    assert ada.client.get(SESSION).status_code == 401
    assert ada.client.delete(SESSION).status_code == 204


def test_a_cookie_that_was_signed_out_elsewhere_says_so(ada: Service) -> None:
    sign_in(ada)
    ada.runtime.store.remove_user(ROOT, ada.runtime.store.user("ada"))
    assert "session has ended" in refusal(ada.client.get("/api/v1/station"))[1]


def test_wrong_name_and_wrong_password_cannot_be_told_apart(ada: Service) -> None:
    assert refusal(sign_in(ada, "ada", "wrong password")) == refusal(sign_in(ada, "eve", "wrong password"))


def test_a_refused_sign_in_is_in_the_log_with_its_address(
    ada: Service, caplog: pytest.LogCaptureFixture
) -> None:
    sign_in(ada, "hush", "hush")
    ada.client.post(SESSION, json={"badge": "hush", "pin": "0000"})
    assert [record.message for record in caplog.records if record.name == access.__name__] == [
        "A sign-in from testclient was refused: Name or password is wrong.",
        "A sign-in from testclient was refused: Badge or PIN is wrong.",
    ]


def test_badge_and_pin(ada: Service) -> None:
    ada.runtime.store.add_user(
        ROOT, "Bo", "operator", badge_sha256=secret_hash("0042"), pin_hash=hashed_pin("1234")
    )
    assert ada.client.post(SESSION, json={"badge": "0042", "pin": "9999"}).status_code == 401
    assert ada.client.post(SESSION, json={"badge": "0042", "pin": "1234"}).json()["name"] == "Bo"
    assert ada.client.post(SESSION, json={"badge": "0042", "password": PASSWORD}).status_code == 422


def test_a_thousand_wrong_passwords_leave_stop_and_session_untouched(ada: Service) -> None:
    with TestClient(ada.client.app, base_url="http://station") as signed_in:
        assert signed_in.post(SESSION, json={"name": "ada", "password": PASSWORD}).status_code == 201
        told = [sign_in(ada, "ada", "wrong password") for _ in range(1000)]
        assert [a.status_code for a in told] == [401] * 5 + [429] * 995
        assert 0 < int(told[-1].headers["retry-after"]) <= 60
        assert signed_in.get(SESSION).status_code == 200
        assert signed_in.post("/api/v1/stop").json()["confirmed"]


def test_the_panel_stops_without_signing_in_and_others_do_not(closed: Service) -> None:
    run = closed.runtime.orchestrator
    assert closed.client.post("/api/v1/stop").status_code == 401
    app = closed.client.app
    panel = TestClient(app, base_url="http://127.0.0.1", client=("127.0.0.1", 5000))
    assert panel.post("/api/v1/stop").json()["confirmed"]
    assert panel.post("/api/v1/stop", headers={"Authorization": "Bearer revoked"}).json()["confirmed"]
    assert panel.get("/api/v1/station").status_code == 401
    for through in (
        {"X-Forwarded-For": "192.0.2.9"},
        {"X-Forwarded-For": "127.0.0.1"},
        {"X-Forwarded-For": ""},
        {"X-Forwarded-Proto": "https"},
        {"X-Forwarded-Host": "station"},
        {"Forwarded": "for=127.0.0.1"},
        {"X-Real-IP": "127.0.0.1"},
        {"Via": "1.1 proxy"},
    ):
        assert panel.post("/api/v1/stop", headers=through).status_code == 401, "a proxy that is not declared"
    assert run.running is None


def test_a_history_that_cannot_be_read_keeps_nobody_from_the_stop(
    closed: Service, monkeypatch: pytest.MonkeyPatch
) -> None:
    from station.errors import StoreUnavailable

    def fails(*_: object) -> None:
        raise StoreUnavailable("locked")

    monkeypatch.setattr(closed.runtime.store, "key", fails)
    headers = {"Authorization": "Bearer fbs_1"}
    assert closed.client.post("/api/v1/stop", headers=headers).json()["confirmed"]
    assert closed.client.get("/api/v1/station", headers=headers).status_code == 503


def test_open_mode_says_so_and_a_key_keeps_its_role_there(service: Service) -> None:
    view = service.client.get("/api/v1/station").json()
    assert view["station"]["open"] is True
    assert service.client.get(SESSION).json()["via"] == "open"
    viewer = service.key("viewer")
    assert service.client.post("/api/v1/retract", json={"operator": "ada"}, headers=viewer).status_code == 403
    bad = {"Authorization": "Bearer fbs_unknown"}
    assert service.client.get("/api/v1/station", headers=bad).status_code == 401


def test_nobody_is_read_a_body(closed: Service) -> None:
    """Whoever may not ask learns nothing about what would be refused."""
    answer = closed.client.post(
        "/api/v1/calibrations", content=b"{", headers={"Content-Type": "application/json"}
    )
    assert answer.status_code == 401


def test_health_needs_no_key(closed: Service) -> None:
    closed.wait_for("scale read")
    assert closed.client.get("/healthz").status_code == 200
    assert closed.client.get("/readyz").status_code in (200, 503)


def test_the_first_administrator_comes_in_by_a_link_that_works_once(closed: Service) -> None:
    secret = closed.client.app.state.access.offer_first_administrator()  # type: ignore[attr-defined]
    body = {"secret": secret, "name": "Ada", "password": PASSWORD}
    assert closed.client.post(f"{SESSION}/first", json={**body, "secret": "x"}).status_code == 401
    assert closed.client.post(f"{SESSION}/first", json=body).json()["role"] == "administrator"
    assert closed.client.get("/api/v1/audit").status_code == 200
    assert closed.client.post(f"{SESSION}/first", json={**body, "name": "Eve"}).status_code == 401
    assert closed.client.app.state.access.offer_first_administrator() is None  # type: ignore[attr-defined]


def test_the_link_ends_with_an_administrator_of_the_terminal(closed: Service) -> None:
    secret = closed.client.app.state.access.offer_first_administrator()  # type: ignore[attr-defined]
    body = {"secret": secret, "name": "Eve", "password": PASSWORD}
    closed.runtime.store.add_user(ROOT, "Ada", "administrator", password_hash=HASHED)
    assert "an administrator already" in refusal(closed.client.post(f"{SESSION}/first", json=body))[1]
    assert [user.name for user in closed.runtime.store.users()] == ["Ada"]


@pytest.mark.parametrize("name", ["\u00d6D\u00d6N", "\u00f6d\u00f6n", "O\u0308do\u0308n", " \uff2fdon "])
def test_a_name_is_typed_as_it_comes(closed: Service, name: str) -> None:
    """In other case, composed by another keyboard, in full width: one account, and its tries are counted."""
    stored = "Odon" if "\uff2f" in name else "\u00d6d\u00f6n"
    closed.runtime.store.add_user(ROOT, stored, "operator", password_hash=HASHED)
    assert sign_in(closed, name).json()["name"] == stored
    for typed in (name, stored, name, stored, name):
        assert sign_in(closed, typed, "wrong horse").status_code == 401
    assert sign_in(closed, stored, "wrong horse").status_code == 429


def test_a_stop_by_somebody_with_a_broken_line_in_the_name(service: Service) -> None:
    service.client.post("/api/v1/stop", headers={"X-Operator": "eve%0d%0a2026-11-28 Stop by%E2%80%AE ada"})
    (entry,) = service.client.get("/api/v1/audit").json()["items"]
    assert entry["who"] == r"eve\r\n2026-11-28 Stop by\u202e ada"


def test_the_live_feed_asks_too_and_ends_with_the_session(
    ada: Service, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(live, "LOOK_EVERY_S", 0.02)
    with pytest.raises(WebSocketDisconnect), ada.client.websocket_connect("/api/v1/live"):
        pass
    sign_in(ada)
    cookie = {"cookie": f"{COOKIE}={ada.client.cookies[COOKIE]}"}
    with ada.client.websocket_connect("/api/v1/live", headers=cookie) as feed:
        assert feed.receive_json()["type"] == "snapshot"
        ada.client.delete(SESSION)
        with pytest.raises(WebSocketDisconnect) as ended:
            while True:
                feed.receive_json()
    assert ended.value.code == live.NOT_SIGNED_IN


def test_a_session_ends_by_itself_but_not_while_a_run_is_under_way(ada: Service) -> None:
    sign_in(ada)
    theirs = ada.client.app.state.access  # type: ignore[attr-defined]
    theirs._idle_s = -1.0
    assert ada.client.get(SESSION).status_code == 401
    sign_in(ada)
    theirs._idle_s = 60.0
    run = ada.hold()
    theirs._idle_s = -1.0
    assert ada.client.get(SESSION).status_code == 200
    ada.client.post("/api/v1/stop")
    ada.runtime.orchestrator.wait(run, LIMIT_S)
    assert ada.client.get(SESSION).status_code == 401


def test_a_page_that_was_left_alone_keeps_nobody_signed_in(
    ada: Service, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It goes on asking who is signed in, and opens its live feed again."""
    late_ms = 0
    now_ms = access._now_ms
    monkeypatch.setattr(access, "_now_ms", lambda: now_ms() + late_ms)
    sign_in(ada)
    cookie = {"cookie": f"{COOKIE}={ada.client.cookies[COOKIE]}"}
    by_itself = {UNATTENDED: "1"}
    late_ms = 40 * 60_000
    assert ada.client.get(SESSION).status_code == 200, "somebody is there"
    late_ms = 80 * 60_000
    assert ada.client.get(SESSION, headers=by_itself).status_code == 200
    with ada.client.websocket_connect("/api/v1/live", headers=cookie) as feed:
        assert feed.receive_json()["type"] == "snapshot"
    late_ms = 101 * 60_000
    assert ada.client.get(SESSION, headers=by_itself).status_code == 401


def test_who_has_an_account_cannot_try_those_of_others_without_end(ada: Service) -> None:
    """A sign-in that succeeds forgets the failures of that name, not those of the address."""
    told = []
    for guess in range(8):
        assert sign_in(ada).status_code in (201, 429)
        told.append(sign_in(ada, f"name {guess}", "wrong password").status_code)
    assert told == [401] * 5 + [429] * 3


def test_a_key_stands_in_one_header_alone(closed: Service) -> None:
    shown = closed.key("administrator")["Authorization"]
    key = shown.removeprefix("Bearer ")
    for headers in (
        [("X-API-Key", key)],
        [("Proxy-Authorization", shown)],
        [("Cookie", f"{COOKIE}={key}")],
        [("Authorization", key)],
        [("Authorization", shown), ("Authorization", "Bearer fbs_another")],
        [("Authorization", "Bearer fbs_another"), ("Authorization", shown)],
    ):
        assert closed.client.get("/api/v1/station", headers=headers).status_code == 401, headers
    assert closed.client.get(f"/api/v1/station?access_token={key}").status_code == 401


@pytest.fixture
def sessions(ada: Service) -> tuple[str, str]:
    """Ada's cookie, and that of somebody who has an account too."""
    ada.runtime.store.add_user(ROOT, "Eve", "operator", password_hash=HASHED)
    cookies = []
    for name in ("ada", "eve"):
        sign_in(ada, name)
        cookies.append(ada.client.cookies[COOKIE])
        ada.client.cookies.clear()
    return cookies[0], cookies[1]


def test_a_session_that_another_host_has_set_takes_nobodys_place(
    ada: Service, sessions: tuple[str, str]
) -> None:
    """Hosts of one domain can set cookies for each other: Ada would work under the name of Eve."""
    mine, theirs = sessions
    for both in (f"{COOKIE}={mine}; {COOKIE}={theirs}", f"{COOKIE}={theirs}; {COOKIE}={mine}"):
        assert "two sessions" in refusal(ada.client.get(SESSION, headers={"Cookie": both}))[1]
        assert ada.client.post("/api/v1/stop", headers={"Cookie": both}).json()["confirmed"]
    same = f"{COOKIE}={mine}; {COOKIE}={mine}"
    assert ada.client.get(SESSION, headers={"Cookie": same}).json()["name"] == "Ada"
    unknown = f"{COOKIE}=of-another-station; {COOKIE}={mine}"
    assert ada.client.post("/api/v1/stop", headers={"Cookie": unknown}).json()["confirmed"]
    assert ada.client.delete(SESSION, headers={"Cookie": both}).status_code == 204
    for one in sessions:
        assert ada.client.get(SESSION, headers={"Cookie": f"{COOKIE}={one}"}).status_code == 401


def test_with_tls_no_other_host_can_set_a_session(ada: Service) -> None:
    client = TestClient(ada.client.app, base_url="https://station")
    answer = client.post(SESSION, json={"name": "ada", "password": PASSWORD})
    said = answer.headers["set-cookie"]
    assert said.startswith(f"{HOST_COOKIE}=") and "Secure" in said and "Path=/" in said
    assert "Domain" not in said
    assert client.get(SESSION).json()["name"] == "Ada"
    plain = {"Cookie": f"{COOKIE}={client.cookies[HOST_COOKIE]}"}
    client.cookies.clear()
    assert client.get(SESSION, headers=plain).status_code == 401, "under the name that any host can set"


def test_a_key_that_expires_ends_the_live_feed(closed: Service, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(live, "LOOK_EVERY_S", 0.02)
    later = datetime.now(UTC) + timedelta(hours=1)
    headers = closed.key("viewer", "old", expires_at=later)
    with closed.client.websocket_connect("/api/v1/live", headers=headers) as feed:
        assert feed.receive_json()["type"] == "snapshot"
        monkeypatch.setattr(access, "datetime", Mock(now=Mock(return_value=later + timedelta(seconds=1))))
        with pytest.raises(WebSocketDisconnect) as ended:
            while True:
                feed.receive_json()
    assert ended.value.code == live.NOT_SIGNED_IN and "expired at" in ended.value.reason


def test_a_run_goes_on_when_the_user_who_started_it_is_removed(ada: Service) -> None:
    sign_in(ada)
    run = ada.hold()
    ada.runtime.store.remove_user(ROOT, ada.runtime.store.user("ada"))
    assert ada.client.post(f"/api/v1/calibrations/{run}/abort").status_code == 401
    assert ada.client.post("/api/v1/stop").status_code == 401
    assert ada.runtime.store.summary(run).state == "running"
    another = ada.key("operator", "Bo")
    assert ada.client.post(f"/api/v1/calibrations/{run}/abort", headers=another).status_code == 202
    assert ada.runtime.orchestrator.wait(run, LIMIT_S) == "aborted"
    starts = [entry.who for entry in ada.runtime.store.audit() if entry.action == "run.started"]
    assert starts == ["Ada"]


def test_a_role_that_is_changed_holds_for_the_session_that_is_open(ada: Service) -> None:
    store = ada.runtime.store
    sign_in(ada)
    run = ada.hold()
    store.change_user(ROOT, store.user("ada"), role="viewer")
    assert ada.client.post(f"/api/v1/calibrations/{run}/abort").status_code == 403
    assert ada.client.post("/api/v1/stop").json()["confirmed"], "everybody who is signed in may stop"
    ada.runtime.orchestrator.wait(run, LIMIT_S)
    assert ada.start().status_code == 403
    store.change_user(ROOT, store.user("ada"), role="administrator")
    assert ada.client.get("/api/v1/users").status_code == 200
