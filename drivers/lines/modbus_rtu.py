"""Modbus RTU: one half-duplex line, on a serial port or through a serial device server.

RTU frames have no number, so a late reply would be taken for the next one of that drive: after a missing
reply, ordinary requests wait until none can come any more. A stop does not wait for that, nor does a read of
another drive: at worst it collides with the late reply, and is repeated.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from threading import Lock

from drivers.errors import DeviceError, GarbledReply, LinkLost
from drivers.lines.lane import Gate, Lane
from drivers.lines.modbus_frames import Request, find_rtu_reply, other_rtu_reply, with_check_sum
from drivers.lines.serial import SerialLine
from drivers.lines.url import SerialAddress

_LONGEST_FRAME_BYTES = 256
_SILENCE_BYTES = 3.5
_LEAST_GAP_S = 0.004  # the slowest of the supported drives requires 3 ms
_PATIENCE_S = 0.01
"""Time that a stop waits, beyond the time on the wire, for a reply that a drive may be about to send."""
_SLICE_S = 0.002


@dataclass(slots=True)
class _Stop:
    """A stop frame that waits to be sent, or for its answer."""

    request: Request
    timeout_s: float
    first: bool
    """Whether it is not a repetition."""
    sent_at_s: float | None = None
    reply: bytes | None = None
    error: DeviceError | None = None

    @property
    def open(self) -> bool:
        return self.reply is None and self.error is None


class RtuLink:
    """Exchanges on one line, one at a time; may be called from any thread."""

    def __init__(self, line: SerialLine, timeout_s: float) -> None:
        self.stop_timeouts_s = (timeout_s / 3, timeout_s * 2 / 3, timeout_s * 4 / 3)
        """Time-outs of the attempts to stop: noise may hit the first; a slow drive answers in the last."""
        self._line = line
        self._timeout_s = timeout_s
        self._lane = Lane()
        self._stops: list[_Stop] = []
        self._stops_lock = Lock()
        self._byte_s = 0.0
        if isinstance(line.address, SerialAddress):
            self._byte_s = line.address.format.bits_per_byte / line.address.baud
        self._gap_s = max(_LEAST_GAP_S, _SILENCE_BYTES * self._byte_s)
        self._free_from_s = 0.0
        self._stale_until_s: dict[int, float] = {}
        """Until when a missing reply of a drive may still come."""
        self._overdue: set[int] = set()
        """Drives of which a reply was missing, and may have come since for that to a later request."""

    def exchange(self, request: Request, gate: Gate) -> bytes:
        """The PDU of the reply.

        :param gate: entered to send the frame; its errors are propagated
        :raises LinkLost: there was no reply, or it was given up for a stop
        :raises GarbledReply: the reply is not a possible one
        """
        while True:
            time.sleep(max(0.0, self._waits_until_s(request) - time.monotonic()))
            with self._lane.hold(urgent=False):
                if time.monotonic() >= self._waits_until_s(request):
                    return self._exchange(request, gate)

    def stop(self, request: Request, timeout_s: float, *, first: bool) -> bytes:
        """One attempt, which overtakes all waiting requests and an overdue reply.

        Stops of several drives requested at the same time are sent directly after each other; their answers
        are collected together.  :raises: as `exchange`
        """
        stop = _Stop(request, timeout_s, first)
        with self._stops_lock:
            self._stops.append(stop)
        with self._lane.hold(urgent=True):
            if stop.open:  # otherwise another stop's thread has sent this one too
                self._carry_out_stops()
        if stop.error is not None:
            raise stop.error
        assert stop.reply is not None
        return stop.reply

    def close(self) -> None:
        with self._lane.hold(urgent=False):
            self._line.close()

    def _waits_until_s(self, request: Request) -> float:
        if request.is_read:
            return self._stale_until_s.get(request.unit, 0.0)
        return max(tuple(self._stale_until_s.values()), default=0.0)

    # An ordinary exchange -------------------------------------------------------------------------

    def _exchange(self, request: Request, gate: Gate) -> bytes:
        frame = request.rtu
        try:
            self._send(frame, gate)
            sent_s = time.monotonic()
            on_wire_s = (len(frame) + request.reply_length + 3) * self._byte_s
            received = b""
            while (now_s := time.monotonic()) < sent_s + self._timeout_s:
                if self._lane.urgent_waiting and now_s > sent_s + on_wire_s + _PATIENCE_S:
                    break
                received += self._line.read_some(now_s + _SLICE_S)
                if not request.is_answered_by_a_copy:
                    self._line.refuse_echo(frame, received)
                pdu = find_rtu_reply(received, request)
                if pdu is not None:
                    self._let_overdue_replies_pass(request.unit)
                    self._free_from_s = time.monotonic() + self._gap_s
                    return pdu
            raise self._no_reply(request, received)
        except DeviceError:
            self._expect_late_reply(request.unit)
            raise

    def _send(self, frame: bytes, gate: Gate) -> None:
        time.sleep(max(0.0, self._free_from_s - time.monotonic()))
        self._line.drain(0)
        with gate():
            self._line.write(frame)
        self._free_from_s = time.monotonic() + len(frame) * self._byte_s + self._gap_s

    def _no_reply(self, request: Request, received: bytes) -> DeviceError:
        self._line.renew()
        if not received:
            return LinkLost(
                f"Drive {request.unit} does not answer on {self._line.address};"
                " check cable, power and address."
            )
        if request.rtu in received:
            return self._line.echoes()
        what = other_rtu_reply(received, request) or f"it answered {received[:16].hex(' ')}"
        return GarbledReply(
            f"Drive {request.unit} gave no proper reply on {self._line.address}: {what};"
            " check the line for noise and double addresses."
        )

    def _let_overdue_replies_pass(self, unit: int) -> None:
        """The reply to a repetition may have been the late one to the first request: then the reply to the
        repetition follows, and would be taken for that to the next request.
        """
        if unit not in self._overdue:
            return
        silent_from_s = time.monotonic()
        while (now_s := time.monotonic()) < silent_from_s + self._timeout_s and not self._lane.urgent_waiting:
            if self._line.read_some(now_s + _SLICE_S):
                silent_from_s = time.monotonic()
        self._overdue.discard(unit)

    def _expect_late_reply(self, unit: int) -> None:
        self._overdue.add(unit)
        longest_s = self._timeout_s + _LONGEST_FRAME_BYTES * self._byte_s
        self._stale_until_s[unit] = time.monotonic() + longest_s
        self._free_from_s = time.monotonic() + self._gap_s

    # Stops ----------------------------------------------------------------------------------------

    def _carry_out_stops(self) -> None:
        """Send the pending stops and collect the answers, until each has come or its time is over."""
        received = b""
        while stops := self._open_stops():
            try:
                if not self._line.is_open:
                    self._line.open()
                now_s = time.monotonic()
                unsent = [stop for stop in stops if stop.sent_at_s is None]
                if unsent and now_s >= self._next_stop_s(stops):
                    self._send_stop(unsent[0])
                    continue
                received += self._line.read_some(now_s + _SLICE_S)
                for stop in stops:
                    if stop.sent_at_s is None:
                        continue
                    stop.reply = find_rtu_reply(received, stop.request)
                    if stop.reply is not None:
                        self._free_from_s = time.monotonic() + self._gap_s
                        answer = with_check_sum(bytes((stop.request.unit,)) + stop.reply)
                        received = received.replace(answer, b"", 1)  # it is no answer to the other stops
                    elif time.monotonic() > stop.sent_at_s + stop.timeout_s:
                        stop.error = self._no_reply(stop.request, received)
            except DeviceError as error:  # an error of the line itself
                for stop in stops:
                    stop.error = error
            for stop in stops:
                if stop.error is not None:
                    self._expect_late_reply(stop.request.unit)

    def _open_stops(self) -> list[_Stop]:
        with self._stops_lock:
            self._stops = [stop for stop in self._stops if stop.open]
            return list(self._stops)

    def _next_stop_s(self, stops: list[_Stop]) -> float:
        """The time for the next stop: the last drive has answered, or is slow to answer."""
        waiting = [
            stop.sent_at_s + (len(stop.request.rtu) * 2) * self._byte_s + _PATIENCE_S
            for stop in stops
            if stop.sent_at_s is not None
        ]
        return max([self._free_from_s, *waiting])

    def _send_stop(self, stop: _Stop) -> None:
        stop.sent_at_s = time.monotonic()
        self._line.write(stop.request.rtu)
        if stop.first and not stop.request.is_read:
            self._line.traffic.note_stop(stop.request.unit)
        self._free_from_s = time.monotonic() + len(stop.request.rtu) * self._byte_s + self._gap_s
