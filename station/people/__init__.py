"""Permissions of users: roles, keys, passwords and sessions."""

from __future__ import annotations

from station.people.access import KEY_PREFIX, Access
from station.people.administration import Administration, NewUser, UserChange
from station.people.keys import new_secret, secret_hash
from station.people.openid import OpenId
from station.people.passwords import FEWEST_CHARACTERS, hashed_password, hashed_pin
from station.people.provider import SignInRefused
from station.people.roles import ALLOWED, ROLES, Permission, allowed_roles

__all__ = [
    "ALLOWED",
    "FEWEST_CHARACTERS",
    "KEY_PREFIX",
    "ROLES",
    "Access",
    "Administration",
    "NewUser",
    "OpenId",
    "Permission",
    "SignInRefused",
    "UserChange",
    "allowed_roles",
    "hashed_password",
    "hashed_pin",
    "new_secret",
    "secret_hash",
]
