"""Users and keys over REST: made, changed and ended, each in the audit, no secret ever in an answer."""

from __future__ import annotations

import json
from threading import Barrier, Thread
from typing import Any

import pytest

from station.errors import NotApplicable, NotFound
from station.people import Administration, NewUser, secret_hash
from station.records import STATION, Actor, User
from tests.web.conftest import Service

ROOT = Actor(name="root", via="terminal")
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


BADGE = {"badge": "0042", "pin": "1234"}


def test_a_user_gets_a_badge_another_pin_and_another_badge(closed: Service, root: dict[str, str]) -> None:
    bo = {"name": "Bo", "role": "operator", "password": PASSWORD}
    path = f"{USERS}/{closed.client.post(USERS, json=bo, headers=root).json()['id']}"

    def change(**what: Any) -> Any:
        return closed.client.patch(path, json=what, headers=root)

    def opens(badge: str, pin: str) -> bool:
        status = closed.client.post(SESSION, json={"badge": badge, "pin": pin}).status_code
        assert status in (201, 401)
        return bool(status == 201)

    for field, alone in (("pin", {"badge": "0042"}), ("badge", {"pin": "1234"})):
        refused = change(**alone)
        assert (refused.status_code, refused.json()["field"]) == (422, field)
    assert not opens(**BADGE)
    assert change(**BADGE).json()["has_badge"] is True
    assert opens(**BADGE)
    assert change(pin="98765").status_code == 200
    assert closed.client.get(SESSION).status_code == 401, "whoever knew the PIN that was is signed off"
    assert not opens("0042", "1234") and opens("0042", "98765")
    assert change(badge="0043").status_code == 200
    assert not opens("0042", "98765") and opens("0043", "98765"), "a lost badge opens nothing; the PIN stays"
    assert change(remove_badge=True, pin="1111").json()["field"] == "remove_badge"
    assert opens("0043", "98765")
    assert change(remove_badge=True).json()["has_badge"] is False
    assert closed.client.get(SESSION).status_code == 401
    assert not opens("0043", "98765")
    assert change(remove_badge=True).status_code == 200, "again is harmless"
    assert closed.client.post(SESSION, json={"name": "Bo", "password": PASSWORD}).status_code == 201
    told = audit(closed, root)
    assert [e["action"] for e in told if e["action"].startswith("user.")] == [
        "user.added", "user.badge_changed", "user.pin_changed", "user.pin_changed", "user.badge_changed",
        "user.badge_removed",
    ]  # fmt: skip
    for secret in ("0042", "0043", "1234", "98765", secret_hash("0043").hex(), "argon2"):
        assert secret not in json.dumps([{**e, "hash": "", "at": ""} for e in told])


def test_a_badge_that_cannot_be_given_is_refused_and_nothing_has_changed(
    closed: Service, root: dict[str, str]
) -> None:
    closed.client.post(USERS, json=BO, headers=root)
    cy = {"name": "Cy", "role": "operator", "badge": "0050", "pin": "5555"}
    path = f"{USERS}/{closed.client.post(USERS, json=cy, headers=root).json()['id']}"
    before = len(audit(closed, root))
    for change, status, said in (
        ({"badge": "0042", "pin": "1234", "role": "viewer"}, 422, "Another user has this badge"),
        ({"pin": "12", "role": "viewer"}, 422, "4 digits"),
        ({"pin": "abcd"}, 422, "4 digits"),
        ({"remove_badge": True, "role": "viewer"}, 409, "nothing to sign in with"),
    ):
        refused = closed.client.patch(path, json=change, headers=root)
        assert refused.status_code == status and said in refused.json()["detail"]
    assert len(audit(closed, root)) == before
    assert closed.client.post(SESSION, json={"badge": "0050", "pin": "5555"}).json()["role"] == "operator"
    both = closed.client.patch(path, json={"remove_badge": True, "password": PASSWORD}, headers=root)
    assert both.status_code == 200
    assert closed.client.post(SESSION, json={"name": "Cy", "password": PASSWORD}).status_code == 201


def test_who_signs_in_with_the_provider_gets_no_way_past_it(closed: Service, root: dict[str, str]) -> None:
    store = closed.runtime.store
    eve = store.add_user(STATION, "Eve", "operator", openid_sha256=secret_hash("https://login.example\n7"))
    for change in ({"password": PASSWORD}, BADGE):
        refused = closed.client.patch(f"{USERS}/{eve.id}", json=change, headers=root)
        assert refused.status_code == 409 and "the plant's provider" in refused.json()["detail"]
    assert closed.client.patch(f"{USERS}/{eve.id}", json={"disabled": True}, headers=root).status_code == 200


def test_a_number_of_a_user_is_never_used_again(closed: Service, root: dict[str, str]) -> None:
    """The audit says `user 2`, and so does a page that was loaded before the user was removed."""
    first = closed.client.post(USERS, json=BO, headers=root).json()["id"]
    assert closed.client.delete(f"{USERS}/{first}", headers=root).status_code == 204
    assert closed.client.post(USERS, json=BO, headers=root).json()["id"] == first + 1


def test_two_administrators_who_remove_each_other_leave_one(closed: Service, root: dict[str, str]) -> None:
    """Both are let in before either is gone."""
    administration = Administration(closed.runtime.store)
    ada, bea = (
        administration.add_user(ROOT, NewUser(name, "administrator", PASSWORD)) for name in ("Ada", "Bea")
    )
    at_once = Barrier(2)
    told: list[str] = []

    def remove(other: User) -> None:
        at_once.wait()
        try:
            administration.remove_user(ROOT, other.id)
        except NotApplicable as refused:
            told.append(str(refused))

    both = [Thread(target=remove, args=[user]) for user in (ada, bea)]
    for one in both:
        one.start()
    for one in both:
        one.join()
    assert len(closed.runtime.store.users()) == 1 and len(told) == 1
    assert "last administrator" in told[0]


def test_an_administrator_who_is_removed_meanwhile_removes_nobody(
    closed: Service, root: dict[str, str]
) -> None:
    """Whoever looked at the other one before that was removed."""
    store = closed.runtime.store
    ada = store.add_user(ROOT, "Ada", "administrator", password_hash="none")
    bea = store.add_user(ROOT, "Bea", "administrator", password_hash="none")
    store.remove_user(ROOT, ada, keep_one=True)
    with pytest.raises(NotApplicable):
        store.change_user(ROOT, bea, role="viewer", keep_one=True)
    with pytest.raises(NotApplicable):
        store.change_user(ROOT, bea, disabled=True, keep_one=True)
    with pytest.raises(NotFound):
        store.change_user(ROOT, ada, disabled=True)


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


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("bo", "already"),
        ("\uff22o", "already"),
        ("J\u00dcRGEN", "already"),
        ("Ju\u0308rgen", "already"),
        ("B\u043e", "mixes letters of Cyrillic and Latin"),
        ("B\u200do", "invisible character"),
    ],
)
def test_a_name_that_looks_like_another_is_refused(
    closed: Service, root: dict[str, str], name: str, why: str
) -> None:
    users, keys = "/api/v1/users", "/api/v1/keys"
    for known in ("Bo", "J\u00fcrgen"):
        body = {"name": known, "role": "viewer"}
        assert closed.client.post(users, headers=root, json={**body, "password": "12345678"}).is_success
        assert closed.client.post(keys, headers=root, json=body).is_success
    body = {"name": name, "role": "viewer"}
    for answer in (
        closed.client.post(users, headers=root, json={**body, "password": "12345678"}),
        closed.client.post(keys, headers=root, json=body),
    ):
        assert answer.status_code == 422 and why in answer.json()["detail"]


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
