"""The documented nginx with TLS before the station: page, live feed and stop work, strangers stay out."""

from __future__ import annotations

import json
import re
import shutil
import socket
import ssl
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import httpx2 as httpx
import pytest
from cryptography import x509
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.x509.oid import NameOID
from websockets.exceptions import InvalidStatus
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Origin

from station.people import Administration, NewUser
from station.records import Actor
from tests.station.conftest import SETTINGS
from tests.waiting import all_threads_end, soon
from tests.web.conftest import LIMIT_S, a_runtime, listening
from web.app import create_app
from web.cookies import HOST_COOKIE

CONFIG = Path(__file__).parents[2] / "deploy" / "nginx.conf"
NAME = "station.plant.example"
PAGE = f"https://{NAME}"
PASSWORD = "correct horse"
BEHIND = SETTINGS.model_validate(
    {
        **SETTINGS.model_dump(),
        "service": {"open": False, "hosts": [NAME], "trusted_proxies": ["127.0.0.1"]},
    }
)
NGINX = shutil.which("nginx") or shutil.which("nginx", path="/usr/sbin")
pytestmark = pytest.mark.skipif(NGINX is None, reason="nginx is not installed")


@dataclass
class Proxied:
    """The station as somebody sees it who trusts the plant's certificate."""

    port: int
    trust: ssl.SSLContext
    http: httpx.Client

    def ask(self, method: str, path: str, **request: Any) -> httpx.Response:
        """As a browser, which names the host and, for a command, the page that asks."""
        headers = {"Host": NAME, "Origin": PAGE, **request.pop("headers", {})}
        extensions = {"sni_hostname": NAME}
        return self.http.request(method, path, headers=headers, extensions=extensions, **request)

    def live(self, origin: str = PAGE) -> ClientConnection:
        cookies = "; ".join(f"{cookie.name}={cookie.value}" for cookie in self.http.cookies.jar)
        connection = socket.create_connection(("127.0.0.1", self.port), LIMIT_S)
        uri, headers = f"wss://{NAME}/api/v1/live", {"Cookie": cookies}
        try:
            return connect(
                uri, sock=connection, ssl=self.trust, origin=Origin(origin), additional_headers=headers
            )
        except BaseException:
            connection.close()
            raise


@pytest.fixture(autouse=True)
def no_thread_left() -> None:
    """The tests share a service; `proxied` looks at the end."""


@pytest.fixture(scope="module", params=["as documented", "Host rewritten"])
def proxied(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Proxied]:
    """Signed in as an operator, from a browser that came through the proxy."""
    folder = tmp_path_factory.mktemp("proxy")
    static = folder / "static"
    static.mkdir()
    (static / "index.html").write_text("<title>the page</title>")
    certificate(folder)
    trust = ssl.create_default_context(cafile=str(folder / "tls.crt"))
    with all_threads_end(), a_runtime(folder, BEHIND) as (runtime, _rig):
        root = Actor(name="root", via="terminal")
        Administration(runtime.store).add_user(root, NewUser("Bo", "operator", PASSWORD))
        with (
            listening(create_app(runtime, static=static)) as behind,
            nginx(folder, behind, rewritten=request.param == "Host rewritten") as port,
            httpx.Client(base_url=f"https://127.0.0.1:{port}", verify=trust, timeout=LIMIT_S) as http,
        ):
            one = Proxied(port, trust, http)
            signed_in = one.ask("POST", "/api/v1/session", json={"name": "Bo", "password": PASSWORD})
            assert signed_in.status_code == 201, signed_in.text
            assert "secure" in signed_in.headers["set-cookie"].lower()
            assert signed_in.headers["set-cookie"].startswith(f"{HOST_COOKIE}=")
            yield one


def certificate(folder: Path) -> None:
    """Self-made, for the name of the station."""
    key = ec.generate_private_key(ec.SECP256R1())
    name = x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, NAME)])
    now = datetime.now(UTC)
    made = (
        x509.CertificateBuilder()
        .subject_name(name)
        .issuer_name(name)
        .public_key(key.public_key())
        .serial_number(x509.random_serial_number())
        .not_valid_before(now - timedelta(hours=1))
        .not_valid_after(now + timedelta(hours=1))
        .add_extension(x509.SubjectAlternativeName([x509.DNSName(NAME)]), critical=False)
        .add_extension(x509.BasicConstraints(ca=True, path_length=0), critical=True)
        .add_extension(x509.SubjectKeyIdentifier.from_public_key(key.public_key()), critical=False)
        .sign(key, hashes.SHA256())
    )
    (folder / "tls.crt").write_bytes(made.public_bytes(serialization.Encoding.PEM))
    (folder / "tls.key").write_bytes(
        key.private_bytes(
            serialization.Encoding.PEM, serialization.PrivateFormat.PKCS8, serialization.NoEncryption()
        )
    )


@contextmanager
def nginx(folder: Path, behind: int, *, rewritten: bool) -> Iterator[int]:
    """The documented configuration with other ports and paths, and where wanted another `Host`."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = int(free.getsockname()[1])
    text = CONFIG.read_text(encoding="utf-8")
    changes = {
        "listen 443 ssl": f"listen 127.0.0.1:{port} ssl",
        "http://127.0.0.1:8000": f"http://127.0.0.1:{behind}",
        "/etc/station/": f"{folder}/",
        "events {": f"pid {folder}/nginx.pid;\nerror_log {folder}/error.log;\nevents {{",
        "http {": "http {\n    access_log off;\n"
        + "".join(
            f"    {kind}_temp_path {folder}/{kind};\n"
            for kind in ("client_body", "proxy", "fastcgi", "uwsgi", "scgi")
        ),
    }
    if rewritten:
        changes["proxy_set_header Host $host;"] = "proxy_set_header Host backend.internal:80;"
    for old, new in changes.items():
        assert re.search(re.escape(old), text), f"deploy/nginx.conf has no {old!r} any more"
        text = text.replace(old, new)
    config = folder / "nginx.conf"
    config.write_text(text)
    assert NGINX is not None
    process = subprocess.Popen(
        [NGINX, "-p", str(folder), "-c", str(config), "-g", "daemon off;"],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        soon(lambda: process.poll() is not None or _answers(port))
        assert process.poll() is None, (folder / "error.log").read_text()
        yield port
    finally:
        process.terminate()
        process.wait(LIMIT_S)


def _answers(port: int) -> bool:
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) == 0


def test_the_page_and_its_policies_come_through(proxied: Proxied) -> None:
    answer = proxied.ask("GET", "/history")
    assert answer.status_code == 200 and "the page" in answer.text
    assert "frame-ancestors 'none'" in answer.headers["content-security-policy"]
    assert proxied.ask("GET", "/api/v1/session").json()["name"] == "Bo"


def test_the_live_feed_comes_through_and_goes_on(proxied: Proxied) -> None:
    with proxied.live() as feed:
        first, second = (json.loads(feed.recv(LIMIT_S)) for _ in range(2))
    assert first["type"] == "snapshot" and second["number"] in (first["number"], first["number"] + 1)


def test_the_stop_comes_through(proxied: Proxied) -> None:
    answer = proxied.ask("POST", "/api/v1/stop")
    assert (answer.status_code, answer.json()["confirmed"]) == (200, True)


@pytest.mark.parametrize("headers", [{"Origin": "https://evil.example"}, {"Sec-Fetch-Site": "cross-site"}])
def test_another_page_commands_nothing_through_it(proxied: Proxied, headers: dict[str, str]) -> None:
    answer = proxied.ask("POST", "/api/v1/stop", headers=headers)
    assert (answer.status_code, answer.json()["type"]) == (403, "urn:station:problem:foreign-origin")
    with pytest.raises(InvalidStatus, match="403"):
        proxied.live(origin="https://evil.example")


def test_what_a_client_says_of_itself_is_overwritten(proxied: Proxied) -> None:
    lies = {"X-Forwarded-Host": "evil.example", "X-Forwarded-Proto": "http", "X-Forwarded-For": "192.0.2.1"}
    assert proxied.ask("POST", "/api/v1/stop", headers=lies).status_code == 200
    answer = proxied.ask("GET", "/", headers={"Host": "evil.example"})
    assert (answer.status_code, answer.json()["type"]) == (403, "urn:station:problem:foreign-host")
