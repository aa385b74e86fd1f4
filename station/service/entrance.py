"""The addresses where the service may listen: without any user only for the emulated rig on this computer."""

from __future__ import annotations

import ipaddress
from contextlib import closing
from pathlib import Path

from station.errors import InputRefused
from station.store import Store


def listens_on_loopback(host: str) -> bool:
    """Whether only this computer can reach a service at this address."""
    if host.lower() == "localhost":
        return True
    try:
        return ipaddress.ip_address(host.strip("[]")).is_loopback
    except ValueError:
        return False


def check_entrance(database: Path, host: str, *, emulated: bool) -> None:
    """Check the address before anything is opened.

    :raises InputRefused: others can reach it, or it moves a real machine, and nobody can sign in.
    """
    if emulated and listens_on_loopback(host):
        return
    if database.exists():
        with closing(Store(database, read_only=True)) as store:
            if store.anybody_known():
                return
    why = "moves a real machine" if not emulated else f"is reached by others at {host}"
    raise InputRefused(
        f"This station {why}, and nobody can sign in yet; first run"
        " `station user add NAME --role administrator`, or `station key add NAME --role ROLE`."
    )
