"""Heidenhain ND 280 / 281B / 287 position displays over their serial line.

The measured value is requested with Ctrl-B and is one fixed line of 17 characters (maker's table of the
measured-value output): sign, ten characters of number, blank, unit, sorting, series, CR LF.  `ESC A....CR`
reads the text of the display; such a reply begins with STX, a refusal is NAK.

A number leaves this module only if every character of its line is as in the table, nothing else is on the
line, and the display itself indicates no fault.
"""

from __future__ import annotations

import re
import time
from enum import IntEnum

from drivers.driver import DriverSettings, ScaleDriver, Seconds
from drivers.errors import DeviceError, DeviceFault, GarbledReply, LinkLost
from drivers.lines import SerialLine
from drivers.scales.readout import Readout

_ASK_VALUE = b"\x02"
_STX, _NAK = b"\x02", b"\x15"
_VALUE_LINE = re.compile(rb"([+-])(.{10}) (.)(.)(.)\r\n")
_NUMBER = re.compile(rb" *\d*\.\d{1,7}")
_CURRENT_VALUE = re.compile(rb"\x02([+-]\d{9})\r\n")
_CURRENT_VALUE_STEP_MM = 1e-4
_MM, _FAULT, _INCH = b" ", b"?", b'"'
_OTHER_SERIES = {b"S": "MIN", b"G": "MAX", b"D": "DIFF", b"2": "axis 2", b"F": "the difference of two axes"}
_PRESENT_VALUE_SERIES = (b" ", b"A", b"1")
_INDICATORS = (
    *("REF", "datum 1", "datum 2", "SET", "START", "PRINT", "inch", "<", "=", ">"),
    *("MIN", "ACTL", "MAX", "DIFF"),
)
_LONGEST_REPLY_BYTES = 64
_PAUSE_S = 0.05  # between the lines of one reply it is far shorter
_AGREEMENT_MM = 0.01


class Indicator(IntEnum):
    """State of a symbol on the display's status line."""

    DARK = 0
    LIT = 1
    BLINKING = 2


class HeidenhainSettings(DriverSettings):
    """Options of `protocol = "heidenhain-nd"`."""

    timeout_s: Seconds = 1.0
    """Longest time that a reply may take."""


class HeidenhainND(Readout):
    """A position display as a `LinearScale`; may be called from any thread."""

    def __init__(
        self, url: str, *, name: str = "linear scale", timeout_s: float = 1.0, budget_s: float | None = None
    ) -> None:
        """:param budget_s: time limit for repeated requests; by default three time-outs and half a second

        :raises BadUrl: one sentence about the error in `url`
        """
        line = SerialLine(url, default_baud=9600, default_format="7E2", flow_control=True)
        super().__init__(line, name=name, timeout_s=timeout_s, budget_s=budget_s)
        self._may_have_stale_bytes = False
        self._identity_reply = b""
        self._sent = b""

    @property
    def identity(self) -> tuple[str, ...]:
        """Model and software lines that the display returned at `connect`."""
        lines = self._identity_reply[1:].decode("ascii").split("\r\n")
        return tuple(line.strip() for line in lines if line.strip())

    def connect(self) -> None:
        """Open the line, read the model, and compare the value line with the value on the display.

        :raises DeviceError: with the error and what to check
        """
        with self._lock:
            self._line.open()
            self._may_have_stale_bytes = False
            self._identity_reply = b""
            try:
                self._identity_reply = self._retried(self._ask_identity)
                if self.indicators().get("inch") is Indicator.LIT:
                    raise DeviceFault(f"The {self._name} counts in inches; set it to mm.")
                self._retried(self._compare_values)
            except DeviceError:
                self._line.close()
                raise

    def read_mm(self) -> float:
        """The head's present value in mm.

        :raises DeviceFault: the display marks its value as faulty, or shows another unit or series
        :raises GarbledReply: several consecutive lines were not as in the maker's table
        :raises LinkLost: there is no answer
        """
        with self._lock:
            return self._retried(self._ask_value)

    def indicators(self) -> dict[str, Indicator]:
        """The display's status symbols by name; they depend on the model.

        :raises DeviceError:
        """
        with self._lock:
            return self._retried(self._ask_indicators)

    def error_text(self) -> str | None:
        """The error on the display, None if there is none.

        :raises DeviceError:
        """
        with self._lock:
            return self._retried(self._ask_error_text)

    def _prepare(self) -> None:
        """Ensure that the next reply is the answer to the next request.

        A late reply would otherwise be taken for the following one, and the readings would lag by one
        position. The display answers in order: after the answer with its model, nothing older can follow.
        """
        if not self._may_have_stale_bytes:
            self._line.drain(0)
        elif self._identity_reply:
            self._read_up_to_identity()
        else:
            self._line.drain(self._timeout_s)
        self._may_have_stale_bytes = False

    def _has_failed(self) -> None:
        self._may_have_stale_bytes = True

    def _read_up_to_identity(self) -> None:
        self._send_screen_command("A0000")
        deadline_s = time.monotonic() + self._timeout_s
        received = b""
        while not received.endswith(self._identity_reply):
            more = self._line.read_some(deadline_s)
            if not more:
                raise self._garbled(received) if received else self._silent()
            received += more

    def _ask_value(self) -> float:
        self._send(_ASK_VALUE)
        line = self._read_lines(1)
        self._refuse_trailing_bytes()
        return self._value_mm(line)

    def _value_mm(self, line: bytes) -> float:
        match = _VALUE_LINE.fullmatch(line)
        if match is None:
            raise self._garbled(line)
        sign, number, unit, sorting, series = match.groups()
        if not _printable(unit + sorting + series):
            raise self._garbled(line)
        if unit == _FAULT:
            raise DeviceFault(f"The {self._name} marks its value as faulty: {self._shown_error()}.")
        if unit == _INCH:
            raise DeviceFault(f"The {self._name} counts in inches; set it to mm.")
        if unit != _MM:
            raise DeviceFault(f'The {self._name} shows the unit "{unit.decode("latin-1")}"; set it to mm.')
        if sorting == _FAULT:
            raise DeviceFault(f"The {self._name} has its sorting limits the wrong way round; correct them.")
        if series in _OTHER_SERIES:
            raise DeviceFault(
                f"The {self._name} shows {_OTHER_SERIES[series]} instead of the present value;"
                " change its display."
            )
        if sorting not in (b" ", b"<", b"=", b">") or series not in _PRESENT_VALUE_SERIES:
            raise self._garbled(line)
        if not _NUMBER.fullmatch(number):
            raise self._garbled(line)
        return float(sign + number.strip())

    def _shown_error(self) -> str:
        try:
            text = self._ask_error_text()
        except DeviceError:
            text = None
        return text or "no error text is shown, look at head and cable"

    def _ask_identity(self) -> bytes:
        """Some lines of ten characters; their number depends on the model, so silence ends them."""
        self._send_screen_command("A0000")
        reply = self._read_lines(1)
        while more := self._line.read_some(time.monotonic() + _PAUSE_S):
            reply += more
        if not re.fullmatch(rb"\x02([ -~]{1,13}\r\n)+", reply):
            raise self._garbled(reply)
        return reply

    def _ask_indicators(self) -> dict[str, Indicator]:
        self._send_screen_command("A0900")
        reply = self._read_lines(1)
        if reply == _NAK:
            return {}
        digits = reply[1:-2]
        if reply[:1] != _STX or not re.fullmatch(rb"[012]{10}([012]{4})?", digits):
            raise self._garbled(reply)
        return {
            name: Indicator(int(digit))
            for name, digit in zip(_INDICATORS, digits.decode("ascii"), strict=False)
        }

    def _ask_error_text(self) -> str | None:
        self._send_screen_command("A0301")
        reply = self._read_lines(1)
        if reply == _NAK:
            return None
        if reply[:1] != _STX or not _printable(reply[1:-2]):
            raise self._garbled(reply)
        return reply[1:-2].decode("ascii").strip()

    def _compare_values(self) -> None:
        """Compare the value line with A0200, which has no decimal point: unit, step and sign must agree."""
        value_mm = self._ask_value()
        reply = self._ask_screen("A0200")
        match = _CURRENT_VALUE.fullmatch(reply)
        if match is None:
            raise self._garbled(reply)
        shown_mm = int(match[1]) * _CURRENT_VALUE_STEP_MM
        if abs(shown_mm - value_mm) > _AGREEMENT_MM:
            raise GarbledReply(
                f"The {self._name} printed {value_mm:.4f} mm but shows {shown_mm:.4f} mm;"
                f" check its unit and display step, and that the head stands still."
            )

    def _ask_screen(self, command: str) -> bytes:
        """The one-line reply to a screen command, STX and CR LF included."""
        self._send_screen_command(command)
        reply = self._read_lines(1)
        if reply == _NAK:
            raise DeviceFault(f"The {self._name} refuses {command}; is it an ND 280, 281B or 287?")
        if reply[:1] != _STX:
            raise self._garbled(reply)
        return reply

    def _send_screen_command(self, command: str) -> None:
        self._send(b"\x1b" + command.encode("ascii") + b"\r")

    def _send(self, request: bytes) -> None:
        self._line.write(request)
        self._sent = request

    def _read_lines(self, count: int) -> bytes:
        """Bytes up to the `count`-th CR LF, or a lone NAK, within the time-out."""
        deadline_s = time.monotonic() + self._timeout_s
        reply = b""
        while reply.count(b"\r\n") < count and reply != _NAK:
            if len(reply) > _LONGEST_REPLY_BYTES:
                raise self._garbled(reply)
            more = self._line.read_some(deadline_s)
            if not more:
                if reply:
                    raise self._garbled(reply)
                raise self._silent()
            reply += more
            self._refuse_echo(reply)
        return reply

    def _refuse_echo(self, reply: bytes) -> None:
        """The late reply to a screen command begins with the same character that requests a value."""
        late = self._sent == _ASK_VALUE and reply[:1] == _STX and reply[1:2] not in (b"", b"+", b"-")
        if late:
            raise self._garbled(reply)
        self._line.refuse_echo(self._sent, reply)

    def _refuse_trailing_bytes(self) -> None:
        """More bytes than one line means that some line is not the requested one."""
        surplus = self._line.read_some(time.monotonic())
        if surplus.strip(b"\r\n"):
            raise self._garbled(surplus)

    def _silent(self) -> LinkLost:
        return LinkLost(f"The {self._name} does not answer on {self._line.address}; check cable and power.")

    def _garbled(self, reply: bytes) -> GarbledReply:
        return GarbledReply(
            f"The {self._name} answered {reply!r}, which is not a reply it may give; check the line."
        )


def _printable(text: bytes) -> bool:
    return re.fullmatch(rb"[ -~]*", text) is not None


def _make(settings: HeidenhainSettings) -> HeidenhainND:
    return HeidenhainND(settings.url, timeout_s=settings.timeout_s)


def in_words(data: bytes) -> str:
    """The meaning of sent or received bytes, for readers of a wire log."""
    match = _VALUE_LINE.fullmatch(data)
    if data == _ASK_VALUE:
        return "what is the value?"
    if match is not None:
        fault = ", marked as faulty" if match[3] == _FAULT else ""
        return f"the value is {match[1].decode()}{match[2].decode().strip()}{fault}"
    return f"{data!r}"[2:-1]


DRIVER = ScaleDriver(HeidenhainSettings, _make, in_words)
