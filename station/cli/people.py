"""`station user`, `key` and `audit`: who may use the station, and who did what, while it runs or not."""

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
from station.records import AuditEntry, PersonName, Role, csv_text

_NAME: TypeAdapter[str] = TypeAdapter(PersonName)
_ALL = 1_000_000
_SHOWN = ("n", "at", "who", "via", "role", "action", "subject")
role_option = click.option("--role", type=click.Choice(ROLES), required=True, help="What they may do.")


@click.group("user")
def user_command() -> None:
    """People who sign in at the page."""


@user_command.command("add")
@click.argument("name")
@role_option
@click.option("--password-stdin", is_flag=True, help="Read the password from standard input.")
@click.option("--badge", help="Text of the badge; its PIN is asked for too.")
@config_option
@click.pass_obj
def add_user(
    home: Path, name: str, role: Role, password_stdin: bool, badge: str | None, config: Path | None
) -> None:
    """Add somebody; the password is asked for."""
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
    """Give somebody a new password; whoever is signed in with the old one is signed off."""
    with kept(home, config, writing=True) as store:
        store.user(name)
        store.set_password(at_terminal(), name, hashed_password(_secret("Password", password_stdin)))


@user_command.command("badge")
@click.argument("name")
@click.option("--badge", help="Text of the badge; without it the badge stays.")
@click.option("--remove", is_flag=True, help="Badge and PIN open nothing any more.")
@click.option("--pin-stdin", is_flag=True, help="Read the PIN from standard input.")
@config_option
@click.pass_obj
def change_badge(
    home: Path, name: str, badge: str | None, remove: bool, pin_stdin: bool, config: Path | None
) -> None:
    """Give somebody a badge and a PIN, or another PIN alone, which is asked for; whoever is signed in under
    this name is signed off."""
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
    said = "has no badge any more" if remove else "signs in with the badge and the new PIN"
    click.echo(f"User {user.name} {said}.", err=True)


@user_command.command("change")
@click.argument("name")
@click.option("--role", type=click.Choice(ROLES), help="What they may do from now on.")
@click.option("--disable/--enable", default=None, help="Keep the user, but let nobody in under this name.")
@config_option
@click.pass_obj
def change_user(home: Path, name: str, role: Role | None, disable: bool | None, config: Path | None) -> None:
    """Give somebody another role, or end and renew their right to sign in."""
    with kept(home, config, writing=True) as store:
        user = store.change_user(at_terminal(), store.user(name), role=role, disabled=disable)
    may = "may not sign in" if user.disabled else "may sign in"
    click.echo(f"User {user.name} has the role {user.role} and {may}.", err=True)


@user_command.command("remove")
@click.argument("name")
@click.option("--erase", is_flag=True, help="Forget the name in the audit too; its chain stays whole.")
@config_option
@click.pass_obj
def remove_user(home: Path, name: str, erase: bool, config: Path | None) -> None:
    """Remove somebody and sign them off."""
    with kept(home, config, writing=True) as store:
        known = any(user.name.casefold() == name.casefold() for user in store.users())
        if known or not erase:
            store.remove_user(at_terminal(), store.user(name))
        if erase:
            click.echo(f"The name was erased in {store.erase_name(name)} entries of the audit.", err=True)


@user_command.command("list")
@config_option
@click.pass_obj
def list_users(home: Path, config: Path | None) -> None:
    """Who can sign in."""
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
    """API keys of programs, such as a MES, and the public key of the certificates."""


@key_command.command("add")
@click.argument("name")
@role_option
@click.option("--days", type=click.FloatRange(0, 36500, min_open=True), help="Expires after so many days.")
@config_option
@click.pass_obj
def add_key(home: Path, name: str, role: Role, days: float | None, config: Path | None) -> None:
    """Print a new key, once: the station keeps only its hash."""
    name = _checked(name)
    with open_or_begin(home, config) as store:
        _, key = Administration(store).add_key(at_terminal(), name, role, days)
    click.echo(key)


@key_command.command("public")
@click.pass_obj
def public_key(home: Path) -> None:
    """Print the public key that the certificates of this station are checked with."""
    from station.certificate import public_key_pem  # here, because it takes seconds to load

    click.echo(public_key_pem(home), nl=False)


@key_command.command("list")
@config_option
@click.pass_obj
def list_keys(home: Path, config: Path | None) -> None:
    """Every key that was made; none is shown again."""
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
    """From this moment on the key opens nothing."""
    with kept(home, config, writing=True) as store:
        revoked = store.revoke_key(at_terminal(), key)
    click.echo(f"Key {revoked.id}, {revoked.name}, is revoked.", err=True)


@click.command("audit")
@click.option("--csv", "as_csv", is_flag=True, help="All columns, comma separated, on standard output.")
@click.option("--limit", type=click.IntRange(1), help="Newest so many; 20 on the screen, all as CSV.")
@config_option
@click.pass_obj
def audit_command(home: Path, as_csv: bool, limit: int | None, config: Path | None) -> None:
    """Who did what, the newest first.  Exit status 1: an entry is not as it was written."""
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
        click.echo(f"Entry {checked.broken} of the audit is not as it was written.", err=True)
        raise SystemExit(1)


def _checked(name: str) -> str:
    """:raises InputRefused:"""
    try:
        return _NAME.validate_python(name)
    except ValidationError as error:
        raise InputRefused(
            f"The name {name!r} cannot be used: 1 to 64 letters, digits, blanks and . @ + - _."
        ) from error


def _secret(what: str, from_input: bool) -> str:
    """Asked for twice, or the next line of standard input."""
    if from_input:
        return sys.stdin.readline().rstrip("\r\n")
    secret: str = click.prompt(what, hide_input=True, confirmation_prompt=True, err=True)
    return secret


def _date(at: datetime | None) -> str:
    return f"{at:%Y-%m-%d %H:%M}" if at else ""
