"""`/session/openid`: sign-in with the plant's provider; every outcome is a view of the page."""

from __future__ import annotations

import logging
from typing import Annotated

from fastapi import BackgroundTasks, Depends, Request
from fastapi.responses import RedirectResponse
from pydantic import Field

from station.errors import NotFound
from station.people import OpenId, Permission, SignInRefused
from station.records import Actor, Record
from web.aside import aside, record_later
from web.cookies import sent_sessions, set_session
from web.guarded import Router, needs
from web.problems import documented
from web.routes.parts import TheAccess, TheRuntime

log = logging.getLogger(__name__)

BROWSER = "station_openid"
"""Cookie that binds a sign-in to the browser that began it."""
PATH = "/api/v1/session/openid"
_SEE_OTHER = 303

router = Router(prefix="/session", tags=["session"])


async def _provider(request: Request) -> OpenId:
    """:raises NotFound: the station file names none."""
    provider: OpenId | None = request.app.state.openid
    if provider is None:
        raise NotFound("The station file has no [openid]; sign in with name and password.")
    return provider


TheProvider = Annotated[OpenId, Depends(_provider)]


class SignInWays(Record):
    """The possible ways to sign in."""

    openid: str | None = Field(description="name of the plant's provider, null where there is none")


@router.get("/ways", response_model=SignInWays, dependencies=[needs(Permission.ENTER)])
async def read_ways(request: Request) -> SignInWays:
    """Name and password, badge and PIN, and optionally a provider at `/session/openid`."""
    provider: OpenId | None = request.app.state.openid
    return SignInWays(openid=provider.label if provider else None)


@router.get(
    "/openid",
    status_code=_SEE_OTHER,
    response_class=RedirectResponse,
    responses=documented(404),
    dependencies=[needs(Permission.ENTER)],
)
async def begin(provider: TheProvider, request: Request) -> RedirectResponse:
    """For a browser: redirect to the provider's page."""
    earlier = next(iter(sent_sessions(request)), None)
    try:
        begun = await aside(lambda: provider.begin(_here(request, f"{PATH}/callback"), earlier))
    except SignInRefused as refused:
        return _refused(refused)
    answer = RedirectResponse(begun.url, _SEE_OTHER)
    secure = request.url.scheme == "https"
    # lax: the provider's page redirects back here
    answer.set_cookie(BROWSER, begun.state, path=PATH, httponly=True, samesite="lax", secure=secure)
    return answer


@router.get(
    "/openid/callback",
    status_code=_SEE_OTHER,
    response_class=RedirectResponse,
    responses=documented(404),
    dependencies=[needs(Permission.ENTER)],
)
async def complete(
    provider: TheProvider,
    access: TheAccess,
    runtime: TheRuntime,
    request: Request,
    later: BackgroundTasks,
) -> RedirectResponse:
    """Return from the provider: signed in at the page, or at the sign-in with the reason."""
    given, browser = dict(request.query_params), request.cookies.get(BROWSER)
    try:
        user, earlier = await aside(lambda: provider.complete(given, browser))
    except SignInRefused as refused:
        return _refused(refused)
    if earlier is not None:  # the previous user of this page is no longer there
        await aside(lambda: access.sign_out(earlier))
    cookie = await aside(lambda: access.sign_in_by_provider(user))
    actor = Actor(name=user.name, via="user", role=user.role)
    later.add_task(record_later, runtime.orchestrator, actor, "session.begun", f"user {user.id}")
    answer = RedirectResponse("/", _SEE_OTHER)
    answer.delete_cookie(BROWSER, path=PATH)
    set_session(answer, cookie, request)
    return answer


@router.get(
    "/openid/end",
    status_code=_SEE_OTHER,
    response_class=RedirectResponse,
    responses=documented(404),
    dependencies=[needs(Permission.ENTER)],
)
async def end(provider: TheProvider, request: Request) -> RedirectResponse:
    """After `DELETE /session`: redirect to the provider's own sign-out, which leads back to the sign-in."""
    back = _here(request, "/sign-in")
    address = await aside(lambda: provider.sign_out_url(back))
    return RedirectResponse(address or "/sign-in", _SEE_OTHER)


def _here(request: Request, path: str) -> str:
    """An address of this station as this browser reaches it; `Borders` has checked the name."""
    return str(request.base_url.replace(path=path))


def _refused(refused: SignInRefused) -> RedirectResponse:
    log.warning("Nobody was signed in by the provider: %s", refused)
    return RedirectResponse(f"/sign-in#refused={refused.why}", _SEE_OTHER)
