"""`/session`: signing in and out at the page; `/session/first` makes the first administrator."""

from __future__ import annotations

from functools import partial
from typing import Annotated

from fastapi import BackgroundTasks, Request, Response
from pydantic import Field

from station.errors import FieldRefused
from station.people import FEWEST_CHARACTERS, Access, Permission
from station.records import Actor, PersonName, SignedIn, User
from web.aside import aside, record_later
from web.bodies import Body
from web.cookies import delete_session, sent_sessions, set_session
from web.guarded import Router, needs
from web.problems import documented
from web.routes.parts import TheAccess, TheRuntime

LONGEST = 256

router = Router(prefix="/session", tags=["session"])

Secret = Annotated[str, Field(min_length=1, max_length=LONGEST)]


class SignInBody(Body):
    """Name and password, or badge and PIN."""

    name: Annotated[str, Field(min_length=1, max_length=64)] | None = None
    password: Secret | None = None
    badge: Secret | None = None
    pin: Secret | None = None


class FirstAdministratorBody(Body):
    """The secret of the link that the first start printed, and the new administrator's credentials."""

    secret: Secret
    name: PersonName
    password: Annotated[str, Field(min_length=FEWEST_CHARACTERS, max_length=LONGEST)]


@router.get("", response_model=SignedIn, dependencies=[needs(Permission.READ)])
async def read_session(access: TheAccess, request: Request) -> SignedIn:
    """The author of the request, by session or key; 401 if nobody is signed in."""
    actor: Actor = request.state.actor
    return access.session(actor)


@router.post(
    "",
    status_code=201,
    response_model=SignedIn,
    responses=documented(429),
    dependencies=[needs(Permission.ENTER)],
)
async def sign_in(
    body: SignInBody,
    access: TheAccess,
    runtime: TheRuntime,
    request: Request,
    response: Response,
    later: BackgroundTasks,
) -> SignedIn:
    """Sign in: the answer sets a cookie that only this station's page can send."""
    address = request.client.host if request.client else ""
    if body.badge is not None and body.pin is not None and body.name is None and body.password is None:
        badge, pin = body.badge, body.pin
        cookie, user = await aside(lambda: access.sign_in_by_badge(badge, pin, address))
    elif body.name is not None and body.password is not None and body.badge is None and body.pin is None:
        name, password = body.name, body.password
        cookie, user = await aside(lambda: access.sign_in(name, password, address))
    else:
        raise FieldRefused("name", "Give name and password, or badge and PIN.")
    for earlier in sent_sessions(request):  # the previous user of this page is no longer there
        await aside(partial(access.sign_out, earlier))
    actor = _actor(user)
    later.add_task(record_later, runtime.orchestrator, actor, "session.begun", f"user {user.id}")
    return _signed_in(access, actor, cookie, request, response)


@router.post("/first", status_code=201, response_model=SignedIn, dependencies=[needs(Permission.ENTER)])
async def make_first_administrator(
    body: FirstAdministratorBody, access: TheAccess, request: Request, response: Response
) -> SignedIn:
    """Make the administrator and sign in; works once, with the link that the station printed."""
    cookie, user = await aside(lambda: access.make_first_administrator(body.secret, body.name, body.password))
    return _signed_in(access, _actor(user), cookie, request, response)


@router.delete("", status_code=204, dependencies=[needs(Permission.ENTER)])
async def sign_out(access: TheAccess, request: Request, response: Response) -> None:
    """Sign out; repeating it is harmless."""
    for cookie in sent_sessions(request):
        await aside(partial(access.sign_out, cookie))
    delete_session(response, request)


def _actor(user: User) -> Actor:
    return Actor(name=user.name, via="user", role=user.role)


def _signed_in(access: Access, actor: Actor, cookie: str, request: Request, response: Response) -> SignedIn:
    set_session(response, cookie, request)
    return access.session(actor)
