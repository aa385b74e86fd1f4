"""Sign-in with a certified OpenID Connect provider (npm: oidc-provider) that runs on loopback."""

from __future__ import annotations

import base64
import html
import os
import re
import shutil
import socket
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlsplit

import httpx2 as httpx
import pytest
from joserfc import jwt
from joserfc.jwk import KeySet, OctKey, RSAKey

from station.errors import InputRefused
from station.people import SignInRefused
from station.people.provider import Attempt, Provider
from station.records import Actor
from station.settings import OpenIdSettings, load_settings
from tests.station.conftest import SETTINGS
from tests.web.conftest import LIMIT_S, Service, a_service
from web.cookies import COOKIE
from web.routes.openid import BROWSER

FOLDER = Path(__file__).parent / "provider"
OPENID, SESSION = "/api/v1/session/openid", "/api/v1/session"
ROOT = Actor(name="root", via="terminal")
ROLES = {"station-operators": "operator", "station-admins": "administrator"}
LOGIN_FORM = re.compile(r'<form[^>]* action="([^"]+)"')


@pytest.fixture(scope="module")
def issuer() -> Iterator[str]:
    """The provider's address."""
    search = os.pathsep.join([os.environ["PATH"], str(Path(sys.executable).parent)])
    node = shutil.which("node", path=search)
    if node is None or not (FOLDER / "node_modules").is_dir():
        if os.environ.get("CI") == "true":
            pytest.fail("the provider is needed: `make test` installs it")
        pytest.skip("the provider is not installed: npm ci in tests/web/provider")
    process = subprocess.Popen(
        [node, "provider.js", f"http://station{OPENID}/callback", "http://station/sign-in"],
        cwd=FOLDER,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )
    assert process.stdout is not None
    yield process.stdout.readline().strip()
    process.terminate()
    process.wait(LIMIT_S)
    process.stdout.close()


def settings_of(issuer: str, **more: Any) -> OpenIdSettings:
    return OpenIdSettings.model_validate(
        {"label": "Plant", "issuer": issuer, "client_id": "station", "roles": ROLES, **more}
    )


@contextmanager
def station_with(
    openid: OpenIdSettings | None, tmp_path: Path, patch: pytest.MonkeyPatch
) -> Iterator[Service]:
    service = SETTINGS.service.model_copy(update={"open": False})
    with a_service(
        tmp_path, patch, SETTINGS.model_copy(update={"service": service, "openid": openid})
    ) as made:
        made.client.follow_redirects = False
        yield made


@pytest.fixture
def service(issuer: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Service]:
    with station_with(settings_of(issuer), tmp_path, monkeypatch) as made:
        yield made


@dataclass
class Browser:
    """A browser between station and provider, which keeps the cookies of both."""

    service: Service
    provider: httpx.Client

    def sign_in(self, login: str) -> str:
        """Where it ends up after the provider's page."""
        back = self.at_provider(self.service.client.get(OPENID).headers["location"], login)
        return self.bring(back)

    def at_provider(self, address: str, login: str | None) -> str:
        """Fill in the provider's forms, or give up; the address that leads back to the station."""
        answer = self.provider.get(address)
        while True:
            if answer.is_redirect:
                target = httpx.URL(address).join(answer.headers["location"])
                if target.host == "station":
                    return str(target)
                answer = self.provider.get(target)
                continue
            found = LOGIN_FORM.search(answer.text)
            assert found, answer.text
            action = html.unescape(found[1])
            if login is None:
                answer = self.provider.get(f"{action}/abort")
            elif 'name="login"' in answer.text:
                answer = self.provider.post(action, data={"prompt": "login", "login": login, "password": "x"})
            else:
                answer = self.provider.post(action, data={"prompt": "consent"})

    def bring(self, address: str) -> str:
        parts = urlsplit(address)
        answer = self.service.client.get(f"{parts.path}?{parts.query}")
        assert answer.status_code == 303
        return str(answer.headers["location"])


@pytest.fixture
def browser(service: Service) -> Iterator[Browser]:
    with httpx.Client(timeout=LIMIT_S) as provider:
        yield Browser(service, provider)


def nobody_is_signed_in(service: Service) -> bool:
    return bool(service.client.get(SESSION).status_code == 401)


def test_who_signs_in_there_is_signed_in_here(browser: Browser, service: Service) -> None:
    assert service.client.get(f"{SESSION}/ways").json() == {"openid": "Plant"}
    began = service.client.get(OPENID)
    assert began.status_code == 303, began.text
    asked = parse_qs(urlsplit(began.headers["location"]).query)
    assert asked["code_challenge_method"] == ["S256"] and asked["nonce"] and asked["scope"]
    assert "samesite=lax" in began.headers["set-cookie"].lower()
    assert browser.sign_in("ada") == "/"
    known = service.client.get(SESSION).json()
    assert (known["name"], known["role"], known["via"]) == ("Ada", "administrator", "user"), "the highest"
    (user,) = service.client.get("/api/v1/users").json()["items"]
    assert user["by_provider"] and not user["has_badge"]
    deeds = [(e["action"], e["who"]) for e in service.client.get("/api/v1/audit").json()["items"]]
    assert deeds == [("session.begun", "Ada"), ("user.added", "station")]


def test_the_provider_decides_the_role_at_every_sign_in(
    browser: Browser, service: Service, issuer: str
) -> None:
    assert browser.sign_in("ada") == "/"
    earlier = service.client.cookies[COOKIE]
    lower = settings_of(issuer, roles={"everybody": "viewer"})
    service.client.app.state.openid._settings = lower  # type: ignore[attr-defined]
    assert browser.sign_in("ada") == "/"
    assert service.client.get(SESSION).json()["role"] == "viewer"
    (user,) = service.runtime.store.users()
    assert user.role == "viewer", "the same user"
    service.client.cookies.clear()
    service.client.cookies.set(COOKIE, earlier)
    assert nobody_is_signed_in(service), "who signs in takes the place of who was there"


def test_a_client_with_a_secret(issuer: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "secret").write_text("a-secret-of-thirty-two-characters\n")
    more = {"client_id": "station-with-a-secret", "client_secret_file": tmp_path / "secret"}
    with (
        station_with(settings_of(issuer, **more), tmp_path, monkeypatch) as service,
        httpx.Client(timeout=LIMIT_S) as provider,
    ):
        assert Browser(service, provider).sign_in("bo") == "/"
        assert service.client.get(SESSION).json()["role"] == "operator"


@pytest.mark.parametrize(("login", "why"), [("eve", "no_role"), ("odd", "not_valid"), (None, "cancelled")])
def test_who_is_not_let_in_is_told_why(
    browser: Browser, service: Service, login: str | None, why: str
) -> None:
    back = browser.at_provider(service.client.get(OPENID).headers["location"], login)
    assert browser.bring(back) == f"/sign-in#refused={why}"
    assert nobody_is_signed_in(service) and service.runtime.store.users() == []


def test_a_user_of_the_same_name_is_never_taken_over(browser: Browser, service: Service) -> None:
    service.runtime.store.add_user(ROOT, "bo", "viewer", password_hash="x")
    assert browser.sign_in("bo") == "/sign-in#refused=name_taken"
    assert nobody_is_signed_in(service)


def test_a_disabled_user_stays_out(browser: Browser, service: Service) -> None:
    assert browser.sign_in("bo") == "/"
    (user,) = service.runtime.store.users()
    service.runtime.store.change_user(ROOT, user, disabled=True)
    assert nobody_is_signed_in(service)
    assert browser.sign_in("bo") == "/sign-in#refused=disabled"


def test_an_answer_counts_once_for_its_browser_and_for_a_while(browser: Browser, service: Service) -> None:
    address = service.client.get(OPENID).headers["location"]
    cookie = service.client.cookies[BROWSER]
    back = browser.at_provider(address, "bo")
    service.client.cookies.delete(BROWSER)
    assert browser.bring(back) == "/sign-in#refused=expired", "another browser"
    assert browser.bring(f"{OPENID}/callback") == "/sign-in#refused=expired"
    service.client.cookies.set(BROWSER, cookie)
    assert browser.bring(back) == "/sign-in#refused=expired", "it was used"
    back = browser.at_provider(service.client.get(OPENID).headers["location"], "bo")
    service.client.app.state.openid._clock = lambda: float("inf")  # type: ignore[attr-defined]
    assert browser.bring(back) == "/sign-in#refused=expired"
    assert nobody_is_signed_in(service)


def test_a_code_that_is_none_and_another_issuer_are_refused(browser: Browser, service: Service) -> None:
    for more, why in (
        ("code=none", "not_valid"),
        ("code=none&iss=https://evil.example", "not_valid"),
        ("error=server_error&more=anything", "not_valid"),
        ("error=access_denied", "cancelled"),
    ):
        state = parse_qs(urlsplit(service.client.get(OPENID).headers["location"]).query)["state"][0]
        assert browser.bring(f"{OPENID}/callback?state={state}&{more}") == f"/sign-in#refused={why}"


def test_signing_out_here_leads_to_the_sign_out_there(browser: Browser, service: Service) -> None:
    assert browser.sign_in("bo") == "/"
    assert service.client.get(SESSION).json()["sign_out_at"] == f"{OPENID}/end"
    assert service.client.delete(SESSION).status_code == 204
    assert nobody_is_signed_in(service)
    there = service.client.get(f"{OPENID}/end").headers["location"]
    page = browser.provider.get(there)
    found, secret = LOGIN_FORM.search(page.text), re.search(r'name="xsrf" value="([^"]+)"', page.text)
    assert found and secret
    done = browser.provider.post(html.unescape(found[1]), data={"xsrf": secret[1], "logout": "yes"})
    assert done.headers["location"] == "http://station/sign-in"
    answer = browser.provider.get(service.client.get(OPENID).headers["location"], follow_redirects=True)
    assert 'name="login"' in answer.text, "the provider asks again"


def test_a_provider_that_is_away_or_hangs_holds_up_neither_page_nor_stop(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("station.people.provider.TIMEOUT_S", 0.3)
    with socket.socket() as hanging:
        hanging.bind(("127.0.0.1", 0))
        hanging.listen()
        issuer = f"http://127.0.0.1:{hanging.getsockname()[1]}"
        with station_with(settings_of(issuer), tmp_path, monkeypatch) as service:
            found: list[str] = []
            begin = threading.Thread(
                target=lambda: found.append(service.client.get(OPENID).headers["location"])
            )
            begin.start()
            key = service.key("viewer")
            assert service.client.post("/api/v1/stop", headers=key).json()["confirmed"]
            begin.join()
            assert found == ["/sign-in#refused=unreachable"]
            hanging.close()
            assert service.client.get(OPENID).headers["location"] == "/sign-in#refused=unreachable"
            assert service.client.get(f"{OPENID}/end").headers["location"] == "/sign-in"


def test_without_a_provider_there_is_none(closed: Service) -> None:
    assert closed.client.get(f"{SESSION}/ways").json() == {"openid": None}
    for path in (OPENID, f"{OPENID}/callback", f"{OPENID}/end"):
        answer = closed.client.get(path)
        assert answer.status_code == 404 and "[openid]" in answer.json()["detail"]


KEY = RSAKey.generate_key(2048, {"kid": "1"}, private=True)
NOW = 2_000_000_000
GOOD = {
    "iss": "https://login.example", "aud": "station", "sub": "1", "nonce": "n", "exp": NOW + 60, "iat": NOW,
}  # fmt: skip


@pytest.mark.parametrize(
    ("changed", "accepted"),
    [
        ({}, True),
        ({"aud": ["station", "other"], "azp": "station"}, True),
        ({"iss": "https://evil.example"}, False),
        ({"aud": "other"}, False),
        ({"aud": ["station", "other"], "azp": "other"}, False),
        ({"nonce": "of another sign-in"}, False),
        ({"nonce": None}, False),
        ({"sub": None}, False),
        ({"exp": NOW - 3600}, False),
        ({"exp": None}, False),
        ({"iat": NOW + 3600}, False),
    ],
)
def test_every_claim_of_the_id_token_is_checked(
    monkeypatch: pytest.MonkeyPatch, changed: dict[str, Any], accepted: bool
) -> None:
    claims = {name: value for name, value in {**GOOD, **changed}.items() if value is not None}
    assert believed(monkeypatch, jwt.encode({"alg": "RS256", "kid": "1"}, claims, KEY)) == accepted


def test_a_signature_of_anybody_else_is_not_believed(monkeypatch: pytest.MonkeyPatch) -> None:
    other = RSAKey.generate_key(2048, {"kid": "1"}, private=True)
    public = OctKey.import_key(b"the secret that the client knows as well")
    head, body, _ = jwt.encode({"alg": "RS256", "kid": "1"}, GOOD, KEY).split(".")
    none = base64.urlsafe_b64encode(b'{"alg":"none"}').rstrip(b"=").decode()
    for token in (
        jwt.encode({"alg": "RS256", "kid": "1"}, GOOD, other),
        jwt.encode({"alg": "HS256", "kid": "1"}, GOOD, public),
        f"{head}.{body}.", f"{none}.{body}.", "", "a.b.c",
    ):  # fmt: skip
        assert not believed(monkeypatch, token)


def believed(monkeypatch: pytest.MonkeyPatch, token: str) -> bool:
    monkeypatch.setattr("time.time", lambda: float(NOW))
    provider = Provider(settings_of("https://login.example"))
    keys = KeySet([KEY]).as_dict(private=False)
    try:
        claims = provider._checked({"id_token": token}, keys, "n")
    except SignInRefused as refused:
        assert refused.why == "not_valid"
        return False
    return bool(claims["sub"] == "1")


def test_settings_that_cannot_be_used_are_refused(tmp_path: Path) -> None:
    file = tmp_path / "station.toml"
    rest = '\nclient_id = "s"\n[openid.roles]\nadmins = '
    for text, said in (
        (f'issuer = "http://login.example"{rest}"viewer"', "plain http"),
        (f'issuer = "https://login.example"{rest}"mes"', "roles"),
        (f'issuer = "https://login.example"\nscope = "profile"{rest}"viewer"', "scope"),
    ):
        file.write_text(f"[openid]\n{text}")
        with pytest.raises(InputRefused, match=said):
            load_settings(file)
    with pytest.raises(InputRefused, match="cannot be read"):
        Provider(settings_of("https://login.example", client_secret_file=tmp_path / "none"))
    assert Attempt("v", "n", "r").nonce == "n"
