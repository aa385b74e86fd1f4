"""Which requests are accepted: by requested host name, by origin page, and by proxy."""

from __future__ import annotations

import ipaddress
import re
from collections.abc import Sequence
from ipaddress import IPv4Network, IPv6Network
from typing import Any, cast
from urllib.parse import urlsplit

from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Receive, Scope, Send
from uvicorn.middleware.proxy_headers import ProxyHeadersMiddleware

from web.problems import problem

LOOPBACK = ("127.0.0.1", "localhost", "::1")
SAFE_METHODS = ("GET", "HEAD", "OPTIONS")
POLICY_VIOLATION = 1008
CLOSE = {"Connection": "close"}
"""What follows a refused request on its connection is not read as another one."""
_NETLOC = re.compile(r"[\w.\-]+(:\d+)?|\[[0-9a-f:.]+\](:\d+)?", re.ASCII)


class Forwarded:
    """Accepts the headers of declared proxies: address of the client, scheme, and requested host name."""

    def __init__(self, app: ASGIApp, proxies: Sequence[IPv4Network | IPv6Network]) -> None:
        self._app, self._proxies = app, proxies
        trusted = [str(network) for network in proxies]
        # two descriptions of the same protocol
        self._believing = cast(ASGIApp, ProxyHeadersMiddleware(cast(Any, app), trusted_hosts=trusted))

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "lifespan" or not self._is_proxy(scope):
            await self._app(scope, receive, send)
            return
        scope["forwarded_by"] = scope["client"][0]
        headers = MutableHeaders(scope=scope)
        if host := headers.get("x-forwarded-host"):
            headers["host"] = host.split(",")[0].strip()
        await self._believing(scope, receive, send)

    def _is_proxy(self, scope: Scope) -> bool:
        try:
            address = ipaddress.ip_address((scope.get("client") or [""])[0])
        except ValueError:
            return False
        return any(address in network for network in self._proxies)


class Borders:
    """Refuses host names that are not this station's, and commands and live feeds for other sites' pages.

    Another host can point its own name at this address; the browser then treats both as one site. The name in
    `Host` reveals it.
    """

    def __init__(self, app: ASGIApp, hosts: Sequence[str]) -> None:
        self._app = app
        self._declared = frozenset(host.lower() for host in hosts)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        headers = Headers(scope=scope)
        refused = self._refused(scope, headers)
        if refused is None:
            await self._app(scope, receive, send)
        elif scope["type"] == "websocket":
            await receive()
            await send({"type": "websocket.close", "code": POLICY_VIOLATION, "reason": refused[1][:120]})
        else:
            status, text, kind = refused
            await problem(status, text, kind=kind, headers=CLOSE)(scope, receive, send)

    def _refused(self, scope: Scope, headers: Headers) -> tuple[int, str, str] | None:
        # a proxy and this server could disagree where such a request ends (RFC 9112, section 6.1)
        if "content-length" in headers and "transfer-encoding" in headers:
            return 400, "Send either Content-Length or Transfer-Encoding.", "ambiguous"
        host = headers.get("host", "").lower()
        # a browser always sends the host; a probe with HTTP/1.0 need not
        if "host" in headers and not self._ours(host, scope):
            text = f"This station is not called {host or 'nothing'}; declare the name in [service] hosts."
            return 403, text, "foreign-host"
        commands = scope["type"] == "websocket" or scope["method"] not in SAFE_METHODS
        if commands and not self._from_our_page(headers, host):
            return 403, "Another site's page may not command this station.", "foreign-origin"
        return None

    def _ours(self, host: str, scope: Scope) -> bool:
        name = hostname(host)
        reached = (scope.get("server") or ("", 0))[0]
        return bool(name) and (name in LOOPBACK or name == reached or self._is_declared(host))

    def _is_declared(self, host: str) -> bool:
        return host in self._declared or hostname(host) in self._declared

    def _from_our_page(self, headers: Headers, host: str) -> bool:
        """True unless a browser states that another site's page sends the request."""
        if headers.get("sec-fetch-site", "none") not in ("none", "same-origin"):
            return False
        origins = headers.getlist("origin")
        if not origins:
            return True
        site = urlsplit(origins[0])
        if len(origins) > 1 or site.scheme not in ("http", "https"):
            return False
        # a proxy may have changed `Host`; the public host name is declared then
        return site.netloc.lower() == host or site.netloc.lower() in self._declared


def hostname(netloc: str) -> str:
    """Host name without port and brackets; empty if it is not one."""
    if not _NETLOC.fullmatch(netloc):
        return ""
    try:
        return urlsplit(f"//{netloc}").hostname or ""
    except ValueError:
        return ""
