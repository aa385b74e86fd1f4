"""The cookies that the station sets; no script reads them, and over HTTPS none is sent without it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from fastapi import Response
from starlette.requests import HTTPConnection


@dataclass(frozen=True, slots=True)
class Cookie:
    """One of them: where it is sent to, and whether a page elsewhere can make a browser send it."""

    name: str
    path: str
    same_site: Literal["lax", "strict"]

    def shown_by(self, connection: HTTPConnection) -> str | None:
        """What the browser sent; None where it sent none."""
        return connection.cookies.get(self.name)

    def give(self, response: Response, value: str, connection: HTTPConnection) -> None:
        """To the browser that asks."""
        response.set_cookie(
            self.name,
            value,
            path=self.path,
            httponly=True,
            samesite=self.same_site,
            secure=connection.url.scheme == "https",
        )

    def take_back(self, response: Response) -> None:
        response.delete_cookie(self.name, path=self.path, httponly=True, samesite=self.same_site)


SESSION = Cookie("station_session", "/", "strict")
"""Who is signed in; only this station's page can send it."""
SIGN_IN = Cookie("station_openid", "/api/v1/session/openid", "lax")
"""Binds a sign-in to the browser that began it; lax, because the provider's page leads back here."""
