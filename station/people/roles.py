"""The permissions of each role. A route names the permission that it needs, never a role."""

from __future__ import annotations

from collections.abc import Mapping
from enum import StrEnum
from typing import get_args

from station.records import Role

ROLES: tuple[Role, ...] = get_args(Role)


class Permission(StrEnum):
    """The permission that a route requires."""

    ENTER = "enter"
    """Signing in and out: anybody."""
    STOP = "stop"
    """The quick stop: all signed-in users, and the panel."""
    READ = "read"
    """Everything except keys and audit."""
    START = "start"
    """Start a calibration."""
    ABORT = "abort"
    """End a run; a MES may only end one that it started."""
    OPERATE = "operate"
    """Apply, roll back, separate, retract, answer, import."""
    MAINTAIN = "maintain"
    """Robot files, memories, deliveries, emulator, backup."""
    ADMINISTER = "administer"
    """Users, keys, audit, restore."""


_EVERYBODY = frozenset(ROLES)
_OPERATORS: frozenset[Role] = frozenset({"operator", "engineer", "administrator"})

ALLOWED: Mapping[Permission, frozenset[Role]] = {
    Permission.ENTER: _EVERYBODY,
    Permission.STOP: _EVERYBODY,
    Permission.READ: _EVERYBODY,
    Permission.START: _OPERATORS | {"mes"},
    Permission.ABORT: _OPERATORS | {"mes"},
    Permission.OPERATE: _OPERATORS,
    Permission.MAINTAIN: frozenset({"engineer", "administrator"}),
    Permission.ADMINISTER: frozenset({"administrator"}),
}


def allowed_roles(permission: Permission) -> tuple[Role, ...]:
    """Roles in the order of `ROLES`."""
    return tuple(role for role in ROLES if role in ALLOWED[permission])
