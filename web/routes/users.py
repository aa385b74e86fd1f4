"""`/users`: the users who sign in at the page. Passwords, PINs and badges are never returned."""

from __future__ import annotations

from typing import Annotated

from fastapi import Path, Response
from pydantic import Field

from station.people import Administration, NewUser, Permission, UserChange
from station.records import LARGEST_ID, Actor, PersonName, Record, Role, User
from web.aside import aside
from web.bodies import Body
from web.guarded import Router, needs
from web.problems import documented
from web.routes.parts import TheRuntime
from web.routes.sessions import LONGEST

router = Router(prefix="/users", tags=["people"])

UserId = Annotated[int, Path(ge=1, le=LARGEST_ID)]
Secret = Annotated[str, Field(min_length=1, max_length=LONGEST)]
Administrator = Annotated[Actor, needs(Permission.ADMINISTER)]


class UserBody(Body):
    """A new user: with a password, with badge and PIN, or with both."""

    name: PersonName
    role: Role
    password: Secret | None = Field(default=None, description="8 characters or more")
    badge: Secret | None = Field(default=None, description="text of the badge; needs a PIN")
    pin: Secret | None = Field(default=None, description="4 digits or more; needs a badge")


class UserChangeBody(Body):
    """The changes; omitted fields are unchanged."""

    role: Role | None = None
    disabled: bool | None = Field(default=None, description="true: kept, signed off, not let in again")
    password: Secret | None = Field(default=None, description="signs the user off everywhere")
    badge: Secret | None = Field(
        default=None, description="text of another badge; without `pin` the PIN stays; signs the user off"
    )
    pin: Secret | None = Field(default=None, description="another PIN for the badge; signs the user off")
    remove_badge: bool = Field(default=False, description="true: badge and PIN open nothing any more")


class UserList(Record):
    """Users, by name."""

    items: list[User]
    next: None = None


@router.get("", response_model=UserList, dependencies=[needs(Permission.ADMINISTER)])
def list_users(runtime: TheRuntime) -> UserList:
    """All users who were added and not removed, also disabled ones."""
    return UserList(items=runtime.store.users())


@router.post("", status_code=201, response_model=User)
async def add_user(body: UserBody, by: Administrator, runtime: TheRuntime, response: Response) -> User:
    """Add a user, who can sign in at once."""
    new = NewUser(**body.model_dump())
    user = await aside(lambda: Administration(runtime.store).add_user(by, new))
    response.headers["Location"] = f"/api/v1/users/{user.id}"
    return user


@router.patch("/{user_id}", response_model=User, responses=documented(404, 409))
async def change_user(user_id: UserId, body: UserChangeBody, by: Administrator, runtime: TheRuntime) -> User:
    """Change role, password, badge or PIN, disable or enable; valid from the next request on."""
    change = UserChange(**body.model_dump())
    return await aside(lambda: Administration(runtime.store).change_user(by, user_id, change))


@router.delete("/{user_id}", status_code=204, responses=documented(404, 409))
def remove_user(user_id: UserId, by: Administrator, runtime: TheRuntime) -> None:
    """Remove a user and end their sessions; their actions remain in the audit."""
    Administration(runtime.store).remove_user(by, user_id)
