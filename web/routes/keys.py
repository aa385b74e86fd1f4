"""`/keys`: the keys of programs.  A key is shown once, in the answer that makes it."""

from __future__ import annotations

from typing import Annotated

from fastapi import Path, Response
from pydantic import Field

from station.people import Administration, Permission
from station.records import LARGEST_ID, Actor, ApiKey, PersonName, Record, Role
from web.bodies import Body
from web.guarded import Router, needs
from web.problems import documented
from web.routes.parts import TheRuntime

router = Router(prefix="/keys", tags=["people"])

Administrator = Annotated[Actor, needs(Permission.ADMINISTER)]


class KeyBody(Body):
    """Name of the program that the key is for, and its role."""

    name: PersonName
    role: Role
    days: Annotated[float, Field(gt=0, le=36_500, allow_inf_nan=False)] | None = Field(
        default=None, description="after which it expires; null: never"
    )


class NewKey(Record):
    """A new key."""

    key: str = Field(description="for `Authorization: Bearer KEY`; it cannot be shown again")
    kept: ApiKey


class KeyList(Record):
    """Keys, oldest first."""

    items: list[ApiKey]
    next: None = None


@router.get("", response_model=KeyList, dependencies=[needs(Permission.ADMINISTER)])
def list_keys(runtime: TheRuntime) -> KeyList:
    """All keys ever made, with their last use; the keys themselves are not stored."""
    return KeyList(items=runtime.store.api_keys())


@router.post("", status_code=201, response_model=NewKey)
def add_key(body: KeyBody, by: Administrator, runtime: TheRuntime, response: Response) -> NewKey:
    """Make a key; only this answer contains it."""
    kept, key = Administration(runtime.store).add_key(by, body.name, body.role, body.days)
    response.headers["Location"] = f"/api/v1/keys/{kept.id}"
    return NewKey(key=key, kept=kept)


@router.delete("/{key_id}", response_model=ApiKey, responses=documented(404))
def revoke_key(
    key_id: Annotated[int, Path(ge=1, le=LARGEST_ID)], by: Administrator, runtime: TheRuntime
) -> ApiKey:
    """Revoke the key from now on; it remains in the list. Repeating it is harmless."""
    return runtime.store.revoke_key(by, key_id)
