"""The emulated gateway: framing, absent drives, and a foreign master."""

from __future__ import annotations

import shutil
import socket
import subprocess

import pytest

from drivers.emulated.link import DriveReply, DropLink
from drivers.emulated.modbus_tcp import ModbusTcpGateway
from drivers.emulated.rig import EmulatedRig


def exchange(port: int, request: str, reply_bytes: int) -> str:
    with socket.create_connection(("127.0.0.1", port), timeout=5) as connection:
        connection.sendall(bytes.fromhex(request))
        reply = b""
        while len(reply) < reply_bytes and (more := connection.recv(100)):
            reply += more
    return reply.hex(" ")


def test_a_drive_is_reached_by_its_address_and_an_absent_one_is_0b() -> None:
    gateway = ModbusTcpGateway({3: lambda pdu: DriveReply(pdu[::-1]), 4: lambda pdu: DriveReply(None)})
    try:
        port = gateway.port
        assert exchange(port, "0007 0000 0003 03 0102", 9) == "00 07 00 00 00 03 03 02 01"
        assert exchange(port, "0008 0000 0002 04 03", 9) == "00 08 00 00 00 03 04 83 0b"
        assert exchange(port, "0009 0000 0002 05 03", 9) == "00 09 00 00 00 03 05 83 0b"
    finally:
        gateway.close()


@pytest.mark.parametrize("nonsense", ["0007 0001 0002 03", "0007 0000 0000 03", "0007 0000 FFFF 03"])
def test_nonsense_ends_the_connection(nonsense: str) -> None:
    gateway = ModbusTcpGateway({})
    try:
        assert exchange(gateway.port, nonsense, 1) == ""
    finally:
        gateway.close()


def test_an_order_to_drop_the_link_ends_the_connection() -> None:
    def drop(pdu: bytes) -> DriveReply:
        raise DropLink

    gateway = ModbusTcpGateway({1: drop})
    try:
        assert exchange(gateway.port, "0007 0000 0002 01 03", 1) == ""
    finally:
        gateway.close()


def test_closing_with_a_client_connected() -> None:
    gateway = ModbusTcpGateway({1: lambda pdu: DriveReply(pdu)})
    with socket.create_connection(("127.0.0.1", gateway.port), timeout=5) as connection:
        connection.sendall(bytes.fromhex("0007 0000 0002 01 03"))
        assert connection.recv(100) == bytes.fromhex("0007 0000 0002 01 03")
        gateway.close()
        assert connection.recv(1) == b""


def mbpoll(rig: EmulatedRig, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run the foreign master once against the rig."""
    program = shutil.which("mbpoll")
    if program is None:
        pytest.skip("mbpoll, a Modbus master of other authors, is not installed")
    port = rig.servo_url.rpartition(":")[2]
    return subprocess.run(
        [program, "-m", "tcp", "-p", port, "-0", "-1", *arguments[:-1], "127.0.0.1", *arguments[-1].split()],
        capture_output=True,
        text=True,
        timeout=20,
    )


def test_a_foreign_master_reads_the_position(rig: EmulatedRig) -> None:
    rig.machine.axes[0].put(100_000)
    answer = mbpoll(rig, "-a", "1", "-r", "0x602c", "-t", "4:int", "-B", "")
    assert answer.returncode == 0, answer.stderr
    assert "100000" in answer.stdout


def test_a_foreign_master_enables_and_hears_of_absent_drives(rig: EmulatedRig) -> None:
    written = mbpoll(rig, "-a", "2", "-r", "0x401", "-t", "4", "131")
    assert written.returncode == 0, written.stderr
    outputs = mbpoll(rig, "-a", "2", "-r", "0x602f", "-t", "4", "")
    assert "14" in outputs.stdout  # ready, servo on, brake released
    absent = mbpoll(rig, "-a", "9", "-r", "0x602c", "-t", "4", "")
    assert "Target device failed to respond" in absent.stderr
