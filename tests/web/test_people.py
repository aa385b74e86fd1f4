"""Users and keys over REST: made, changed and ended, each in the audit, no secret ever in an answer."""

from __future__ import annotations

import json
from typing import Any

import pytest

from station.people import secret_hash
from tests.web.conftest import Service

USERS, KEYS, SESSION = "/api/v1/users", "/api/v1/keys", "/api/v1/session"
PASSWORD = "correct horse"
BO = {"name": "Bo", "role": "operator", "password": PASSWORD, "badge": "0042", "pin": "1234"}


@pytest.fixture
def root(closed: Service) -> dict[str, str]:
    return closed.key("administrator", "root")


def audit(service: Service, headers: dict[str, str]) -> list[dict[str, Any]]:
    """Entries after the key of the one who asks was made, oldest first."""
    items: list[dict[str, Any]] = service.client.get("/api/v1/audit", headers=headers).json()["items"]
    return items[::-1][1:]


def test_a_user_is_added_changed_disabled_and_removed(closed: Service, root: dict[str, str]) -> None:
    made = closed.client.post(USERS, json=BO, headers=root)
    assert made.status_code == 201
    user = made.json()
    assert made.headers["location"] == f"{USERS}/{user['id']}"
    assert (user["name"], user["role"], user["has_badge"], user["disabled"]) == (
        "Bo",
        "operator",
        True,
        False,
    )
    assert closed.client.post(SESSION, json={"badge": "0042", "pin": "1234"}).status_code == 201
    assert closed.client.get(SESSION).json()["role"] == "operator"

    def change(**what: Any) -> Any:
        return closed.client.patch(f"{USERS}/{user['id']}", json=what, headers=root)

    assert change(role="viewer").json()["role"] == "viewer"
    assert closed.client.get(SESSION).json()["role"] == "viewer", "it holds at once"
    assert change(disabled=True).json()["disabled"] is True
    assert closed.client.get(SESSION).status_code == 401, "signed off at once"
    assert closed.client.post(SESSION, json={"name": "Bo", "password": PASSWORD}).status_code == 401
    assert closed.client.post(SESSION, json={"badge": "0042", "pin": "1234"}).status_code == 401
    assert change(disabled=False, password="another horse").status_code == 200
    assert closed.client.post(SESSION, json={"name": "Bo", "password": "another horse"}).status_code == 201
    assert closed.client.get(USERS, headers=root).json()["items"][0]["name"] == "Bo"
    assert closed.client.delete(f"{USERS}/{user['id']}", headers=root).status_code == 204
    assert closed.client.delete(f"{USERS}/{user['id']}", headers=root).status_code == 404
    told = [entry["action"] for entry in audit(closed, root) if entry["action"].startswith("user.")]
    assert told == [
        "user.added", "user.role_changed", "user.disabled", "user.enabled", "user.password_changed",
        "user.removed",
    ]  # fmt: skip
    assert all(entry["who"] == "root" for entry in audit(closed, root) if entry["action"] in told)


def test_no_secret_comes_out_again(closed: Service, root: dict[str, str]) -> None:
    closed.client.post(USERS, json=BO, headers=root)
    refused = closed.client.post(USERS, json={**BO, "name": "Cy", "password": "short"}, headers=root)
    assert refused.status_code == 422 and refused.json()["field"] == "password"
    said = [refused.text]
    said += [closed.client.get(path, headers=root).text for path in (USERS, KEYS, "/api/v1/audit")]
    for secret in (PASSWORD, "0042", "1234", "short", "argon2"):
        assert all(secret not in json.dumps(json.loads(text)["items"]) for text in said[1:])
    assert '"short"' not in refused.text


@pytest.mark.parametrize(
    ("body", "field"),
    [
        ({"name": "Cy", "role": "viewer"}, "password"),
        ({"name": "Cy", "role": "viewer", "badge": "7"}, "pin"),
        ({"name": "Cy", "role": "viewer", "password": PASSWORD, "pin": "1234"}, "pin"),
        ({"name": "Cy", "role": "viewer", "badge": "7", "pin": "12"}, "pin"),
        ({"name": "Cy", "role": "king", "password": PASSWORD}, "role"),
        ({"name": "C\ty", "role": "viewer", "password": PASSWORD}, "name"),
        ({"name": "Cy", "role": "viewer", "password": PASSWORD, "admin": True}, "admin"),
    ],
)
def test_a_user_that_cannot_be_is_refused(
    closed: Service, root: dict[str, str], body: dict[str, Any], field: str
) -> None:
    refused = closed.client.post(USERS, json=body, headers=root)
    assert (refused.status_code, refused.json()["field"]) == (422, field)
    assert closed.client.get(USERS, headers=root).json()["items"] == []


def test_the_last_administrator_stays(closed: Service, root: dict[str, str]) -> None:
    ada = {"name": "Ada", "role": "administrator", "password": PASSWORD}
    path = f"{USERS}/{closed.client.post(USERS, json=ada, headers=root).json()['id']}"
    for refused in (
        closed.client.patch(path, json={"role": "viewer"}, headers=root),
        closed.client.patch(path, json={"disabled": True}, headers=root),
        closed.client.delete(path, headers=root),
    ):
        assert refused.status_code == 409 and "last administrator" in refused.json()["detail"]
    closed.client.post(USERS, json={**ada, "name": "Bea"}, headers=root)
    assert closed.client.delete(path, headers=root).status_code == 204


def test_a_key_is_shown_once_works_and_is_revoked(closed: Service, root: dict[str, str]) -> None:
    made = closed.client.post(KEYS, json={"name": "line 4", "role": "mes", "days": 30}, headers=root)
    assert made.status_code == 201
    key, kept = made.json()["key"], made.json()["kept"]
    assert key.startswith("fbs_") and kept["expires_at"] is not None
    mine = {"Authorization": f"Bearer {key}"}
    assert closed.client.get(SESSION, headers=mine).json()["name"] == "line 4"
    listed = closed.client.get(KEYS, headers=root)
    assert [k["name"] for k in listed.json()["items"]] == ["root", "line 4"]
    assert key not in listed.text and secret_hash(key).hex() not in listed.text
    assert closed.client.post(KEYS, json={"name": "line 4", "role": "mes"}, headers=root).status_code == 422
    for _ in range(2):
        revoked = closed.client.delete(f"{KEYS}/{kept['id']}", headers=root)
        assert revoked.status_code == 200 and revoked.json()["revoked_at"] is not None
    assert closed.client.get(SESSION, headers=mine).status_code == 401
    assert [e["action"] for e in audit(closed, root)] == ["key.added", "key.revoked"]


@pytest.mark.parametrize("days", [0, -1, 1e9, "soon"])
def test_a_key_that_cannot_be_is_refused(closed: Service, root: dict[str, str], days: object) -> None:
    refused = closed.client.post(KEYS, json={"name": "x", "role": "mes", "days": days}, headers=root)
    assert (refused.status_code, refused.json()["field"]) == (422, "days")
