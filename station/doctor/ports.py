"""Information on a port without communication: its names, its users, whether it can be opened."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from drivers.errors import DeviceError
from drivers.lines import NetAddress, SerialAddress, SerialLine
from station.doctor.finding import Finding

BY_ID = Path("/dev/serial/by-id")
_PSEUDO = "/dev/pts/"


def examine_port(line: SerialLine, finding: Finding, *, emulated: bool = False, by_id: Path = BY_ID) -> bool:
    """Add findings on the port of a line; returns whether it can be opened.  The line is closed afterwards.

    :param emulated: the rig holds the other end open as well
    """
    address = line.address
    if isinstance(address, SerialAddress) and not emulated:
        _names(address, finding, by_id)
        holders = sorted(set(holders_of(Path(address.port))))
        if holders:
            finding.add(
                f"held by {', '.join(holders)} too",
                "trouble",
                "end that program; two that read one port take each other's bytes",
            )
    began_s = time.monotonic()
    try:
        line.open()
    except DeviceError as error:
        finding.add(str(error), "trouble", _what_to_do(address, by_id))
        return False
    took_ms = (time.monotonic() - began_s) * 1000
    try:
        if isinstance(address, NetAddress):
            finding.add(f"connects within {took_ms:.1f} ms")
        else:
            _format(address, finding)
    finally:
        line.close()
    return True


def holders_of(port: Path) -> Iterator[str]:
    """Other programs that have a device open, as far as visible to this user."""
    device = port.resolve()
    for process in Path("/proc").glob("[0-9]*"):
        if process.name == str(os.getpid()):
            continue
        with suppress(OSError):  # closed meanwhile, or another user's
            if any(_is(link, device) for link in (process / "fd").iterdir()):
                name = (process / "comm").read_text(encoding="utf-8").strip()
                yield f"{name} (process {process.name})"


def _is(link: Path, device: Path) -> bool:
    with suppress(OSError):
        return link.readlink() == device
    return False


def _names(address: SerialAddress, finding: Finding, by_id: Path) -> None:
    port = Path(address.port)
    if by_id in port.parents:
        finding.add(f"names its adapter; it is {port.resolve()} at present")
        return
    names = [name for name in _known(by_id) if name.resolve() == port.resolve()]
    if names:
        finding.add(
            f"its adapter is {names[0].name}",
            "note",
            f"name it {names[0]} in the station file: {address.port} may be another one after plugging",
        )
    elif not str(port.resolve()).startswith(_PSEUDO) and port.exists():
        finding.add(
            f"has no name under {by_id}",
            "note",
            "its adapter has no serial number; a udev rule can name it by its socket",
        )


def _known(by_id: Path) -> list[Path]:
    return sorted(by_id.iterdir()) if by_id.is_dir() else []


def _what_to_do(address: SerialAddress | NetAddress, by_id: Path) -> str:
    if isinstance(address, NetAddress):
        return "check that the gateway is switched on, its network address and its port"
    there = ", ".join(str(name) for name in _known(by_id))
    return f"adapters there are: {there or 'none'}"


def _format(address: SerialAddress, finding: Finding) -> None:
    """The port has been opened, so it accepted the format: `open` compares."""
    wanted = address.effective_format
    parity = "no parity" if wanted.parity == "N" else "parity is checked"
    text = f"runs with {address.baud} baud, {wanted}, {parity}"
    if address.notice is None:
        finding.add(text)
    else:
        finding.add(
            f"{text}, in place of {address.format}", "note", "remove override= unless the port is emulated"
        )
    if address.echo:
        finding.add("its adapter sends back what it is sent, as echo=1 says")
