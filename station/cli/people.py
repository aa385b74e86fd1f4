"""`station user`, `key` and `audit`: users, keys and the audit, with or without the service running."""

from __future__ import annotations

import sys
from datetime import datetime
from pathlib import Path

import click
from pydantic import TypeAdapter, ValidationError

from station.cli.kept import at_terminal, config_option, kept, open_or_begin
from station.cli.listing import print_list
from station.errors import InputRefused
from station.people import ROLES, Administration, NewUser, UserChange, hashed_password
from station.records import AuditEntry, PersonName, Role, account_key, csv_text, said

_NAME: TypeAdapter[str] = TypeAdapter(PersonName)
_ALL = 1_000_000
_SHOWN = ("n", "at", "who", "via", "role", "action", "subject")
role_option = click.option(
    "--role", type=click.Choice(ROLES), required=True, help="Role, which determines the permissions."
)


@click.group("user")
def user_command() -> None:
    """Manage the users who sign in on the page."""


@user_command.command("add")
@click.argument("name")
@role_option
@click.option("--password-stdin", is_flag=True, help="Read the password from standard input.")
@click.option("--badge", help="Text of the badge; the command asks for its PIN, too.")
@config_option
@click.pass_obj
def add_user(
    home: Path, name: str, role: Role, password_stdin: bool, badge: str | None, config: Path | None
) -> None:
    """Add a user; the command asks for the password."""
    name = _checked(name)
    password = _secret("Password", password_stdin)
    pin = _secret("PIN", password_stdin) if badge else None
    with open_or_begin(home, config) as store:
        user = Administration(store).add_user(
            at_terminal(), NewUser(name, role, password, badge or None, pin)
        )
    click.echo(f"User {user.name} may sign in with the role {user.role}.", err=True)


@user_command.command("password")
@click.argument("name")
@click.option("--password-stdin", is_flag=True, help="Read the password from standard input.")
@config_option
@click.pass_obj
def change_password(home: Path, name: str, password_stdin: bool, config: Path | None) -> None:
    """Set a new password and end the sessions of the user."""
    with kept(home, config, writing=True) as store:
        store.user(name)
        store.set_password(at_terminal(), name, hashed_password(_secret("Password", password_stdin)))


@user_command.command("badge")
@click.argument("name")
@click.option("--badge", help="Text of the new badge.  [default: the badge does not change]")
@click.option("--remove", is_flag=True, help="Remove badge and PIN.")
@click.option("--pin-stdin", is_flag=True, help="Read the PIN from standard input.")
@config_option
@click.pass_obj
def change_badge(
    home: Path, name: str, badge: str | None, remove: bool, pin_stdin: bool, config: Path | None
) -> None:
    """Set a badge and a PIN, or only a new PIN, and end the sessions of the user.

    The command asks for the PIN.
    """
    if remove and (badge is not None or pin_stdin):
        raise click.UsageError("Give another badge or PIN, or --remove; not both.")
    with kept(home, config, writing=True) as store:
        user = store.user(name)
        change = (
            UserChange(remove_badge=True)
            if remove
            else UserChange(badge=badge or None, pin=_secret("PIN", pin_stdin))
        )
        Administration(store).change_user(at_terminal(), user.id, change)
    said = "no longer has a badge" if remove else "signs in with the badge and the new PIN"
    click.echo(f"User {user.name} {said}.", err=True)


@user_command.command("change")
@click.argument("name")
@click.option("--role", type=click.Choice(ROLES), help="New role.")
@click.option("--disable/--enable", default=None, help="Forbid or permit the user to sign in.")
@config_option
@click.pass_obj
def change_user(home: Path, name: str, role: Role | None, disable: bool | None, config: Path | None) -> None:
    """Change the role of a user, or forbid or permit the user to sign in."""
    with kept(home, config, writing=True) as store:
        user = store.change_user(at_terminal(), store.user(name), role=role, disabled=disable)
    may = "may not sign in" if user.disabled else "may sign in"
    click.echo(f"User {user.name} has the role {user.role} and {may}.", err=True)


@user_command.command("remove")
@click.argument("name")
@click.option("--erase", is_flag=True, help="Erase the name in the audit, too; its chain remains valid.")
@config_option
@click.pass_obj
def remove_user(home: Path, name: str, erase: bool, config: Path | None) -> None:
    """Remove a user and end the user's sessions."""
    with kept(home, config, writing=True) as store:
        known = any(account_key(user.name) == account_key(name) for user in store.users())
        if known or not erase:
            store.remove_user(at_terminal(), store.user(name))
        if erase:
            click.echo(f"The name was erased in {store.erase_name(name)} entries of the audit.", err=True)


@user_command.command("list")
@config_option
@click.pass_obj
def list_users(home: Path, config: Path | None) -> None:
    """List the users."""
    with kept(home, config) as store:
        rows = [
            (
                str(u.id), u.name, u.role, "yes" if u.has_badge else "", "yes" if u.disabled else "",
                _date(u.created_at),
            )
            for u in store.users()
        ]  # fmt: skip
    print_list(("id", "name", "role", "badge", "disabled", "created"), rows, "No users.")


@click.group("key")
def key_command() -> None:
    """Manage API keys of programs, such as a MES, and print the public key of the certificates."""


@key_command.command("add")
@click.argument("name")
@role_option
@click.option(
    "--days", type=click.FloatRange(0, 36500, min_open=True), help="Validity in days.  [default: unlimited]"
)
@config_option
@click.pass_obj
def add_key(home: Path, name: str, role: Role, days: float | None, config: Path | None) -> None:
    """Print a new key.  It cannot be shown again: the station stores only its hash."""
    name = _checked(name)
    with open_or_begin(home, config) as store:
        _, key = Administration(store).add_key(at_terminal(), name, role, days)
    click.echo(key)


@key_command.command("public")
@click.pass_obj
def public_key(home: Path) -> None:
    """Print the public key with which the certificates of this station are checked."""
    from station.certificate import public_key_pem  # here, because it takes seconds to load

    click.echo(public_key_pem(home), nl=False)


@key_command.command("list")
@config_option
@click.pass_obj
def list_keys(home: Path, config: Path | None) -> None:
    """List all keys, without their text."""
    with kept(home, config) as store:
        rows = [
            (str(k.id), k.name, k.role, *map(_date, (k.created_at, k.expires_at, k.revoked_at, k.used_at)))
            for k in store.api_keys()
        ]
    print_list(("id", "name", "role", "created", "expires", "revoked", "used"), rows, "No keys.")


@key_command.command("revoke")
@click.argument("key", metavar="NAME|ID")
@config_option
@click.pass_obj
def revoke_key(home: Path, key: str, config: Path | None) -> None:
    """Revoke a key at once."""
    with kept(home, config, writing=True) as store:
        revoked = store.revoke_key(at_terminal(), key)
    click.echo(f"Key {revoked.id}, {revoked.name}, is revoked.", err=True)


@click.command("audit")
@click.option("--csv", "as_csv", is_flag=True, help="Write all columns as CSV to standard output.")
@click.option(
    "--limit", type=click.IntRange(1), help="Number of rows.  [default: 20 on the screen, all as CSV]"
)
@config_option
@click.pass_obj
def audit_command(home: Path, as_csv: bool, limit: int | None, config: Path | None) -> None:
    """Show the audit, newest entry first, and check its chain.  Exit status 1: an entry was changed."""
    with kept(home, config) as store:
        checked = store.check_audit()
        entries = store.audit(limit=limit or (_ALL if as_csv else 20))
    rows = [entry.model_dump(mode="json") for entry in entries]
    if as_csv:
        columns = list(AuditEntry.model_fields)
        click.echo(csv_text(columns, ([row[c] for c in columns] for row in rows)), nl=False)
    else:
        shown = [tuple("" if row[c] is None else str(row[c])[:19] for c in _SHOWN) for row in rows]
        print_list(_SHOWN, shown, "Nothing yet.")
    if checked.broken is not None:
        click.echo(f"Entry {checked.broken} of the audit was changed.", err=True)
        raise SystemExit(1)


def _checked(name: str) -> str:
    """:raises InputRefused:"""
    try:
        return _NAME.validate_python(name)
    except ValidationError as error:
        why = said(error.errors()[0])
        text = f"The name {name!r} cannot be used: 1 to 64 letters, digits, blanks and . @ + - _. {why}."
        raise InputRefused(f"{text.rstrip('.')}.") from error


def _secret(what: str, from_input: bool) -> str:
    """Asked for twice, or the next line of standard input."""
    if from_input:
        return sys.stdin.readline().rstrip("\r\n")
    secret: str = click.prompt(what, hide_input=True, confirmation_prompt=True, err=True)
    return secret


def _date(at: datetime | None) -> str:
    return f"{at:%Y-%m-%d %H:%M}" if at else ""
