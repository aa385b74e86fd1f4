"""The cookie of a session: its name, its attributes, and how it is read from a request."""

from __future__ import annotations

from fastapi import Response
from starlette.requests import HTTPConnection

from station.errors import NotSignedIn

COOKIE = "station_session"
HOST_COOKIE = f"__Host-{COOKIE}"
"""With TLS: a browser accepts it only from this host, not from another one of the plant's domain."""


def sent_sessions(connection: HTTPConnection) -> list[str]:
    """All session cookies of a request; more than one only if another host has set one too."""
    name = _name(connection)
    pairs = ";".join(connection.headers.getlist("cookie")).split(";")
    found = (
        value.strip() for key, _, value in (pair.partition("=") for pair in pairs) if key.strip() == name
    )
    return list(dict.fromkeys(found))


def sent_session(connection: HTTPConnection) -> str | None:
    """:raises NotSignedIn: two cookies are ambiguous."""
    sent = sent_sessions(connection)
    if len(sent) > 1:
        raise NotSignedIn(
            "The browser shows two sessions, one of which another host has set; delete the cookies of this"
            " host and sign in again."
        )
    return sent[0] if sent else None


def set_session(response: Response, cookie: str, connection: HTTPConnection) -> None:
    """Set a cookie that only this station's page can send."""
    secure = _by_tls(connection)
    response.set_cookie(_name(connection), cookie, path="/", httponly=True, samesite="strict", secure=secure)


def delete_session(response: Response, connection: HTTPConnection) -> None:
    """Delete the cookie in the browser."""
    secure = _by_tls(connection)
    response.delete_cookie(_name(connection), path="/", httponly=True, samesite="strict", secure=secure)


def _name(connection: HTTPConnection) -> str:
    return HOST_COOKIE if _by_tls(connection) else COOKIE


def _by_tls(connection: HTTPConnection) -> bool:
    return connection.url.scheme in ("https", "wss")
