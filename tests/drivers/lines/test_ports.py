"""A serial port is opened for this process alone, and checks parity where parity is asked for."""

from __future__ import annotations

import fcntl
import struct
import termios

import pytest

from drivers.lines.ports import open_serial_port, with_parity_check
from drivers.lines.url import LineFormat, SerialAddress
from tests.drivers.wire import PtyEnd

TIOCGEXCL = 0x80045440
PLAIN = LineFormat(8, "N", 1)


def test_no_other_program_can_open_the_port_meanwhile() -> None:
    """Not even one that knows nothing of advisory locks; afterwards it can."""
    with PtyEnd([]) as end:
        port = open_serial_port(SerialAddress(end.port, 9600, PLAIN, None), xonxoff=True)
        assert struct.unpack("i", fcntl.ioctl(port.fileno(), TIOCGEXCL, b"    "))[0] == 1
        port.close()


@pytest.mark.parametrize("before", [0, termios.IGNPAR, termios.PARMRK, termios.IGNPAR | termios.IXON])
def test_a_byte_of_wrong_parity_is_marked(before: int) -> None:
    """Marked as NUL: neither passed on as it came nor dropped."""
    flags = with_parity_check(before)
    assert flags & termios.INPCK
    assert not flags & (termios.IGNPAR | termios.PARMRK)
    assert flags & termios.IXON == before & termios.IXON
