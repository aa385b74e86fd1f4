"""What is written of a line, and that it reads back as it was."""

from __future__ import annotations

from itertools import count
from threading import Thread

import pytest

from drivers.errors import LinkLost
from drivers.lines import Departed, Playback, SerialLine, WireEvent, WireLog, wire_events
from drivers.lines.serial import Recorder


def recorded(*happenings: tuple[str, bytes], elsewhere: bool = False) -> str:
    line = SerialLine("serial:///dev/ttyNONE")
    log = WireLog({1: line}, clock=(tick / 1000 for tick in count()).__next__)
    recorder = line.recorder
    assert recorder is not None

    def happen(recorder: Recorder) -> None:
        for what, data in happenings:
            recorder(what, data)  # type: ignore[arg-type]

    if elsewhere:
        thread = Thread(target=happen, args=(recorder,))
        thread.start()
        thread.join()
    else:
        happen(recorder)
    log.note_clock(1234567)
    log.close()
    assert line.recorder is None
    return log.take()


def test_one_line_of_text_for_each_happening() -> None:
    assert recorded(("tx", b"\x02"), ("rx", b"+1")) == "10 1> 02\n10 1< 2b31\n10 0c 31323334353637\n"


def test_what_another_thread_did_is_marked() -> None:
    first, *_ = wire_events(recorded(("tx", b"\x02"), elsewhere=True).splitlines())
    assert first == WireEvent(10 * 1e-4, 1, "tx", b"\x02", own=False)


def test_that_nothing_was_there_is_written_if_something_came_afterwards() -> None:
    text = recorded(
        ("tx", b"a"), ("rx", b"b"), ("nothing", b""), ("rx", b"c"), ("nothing", b""), ("tx", b"d")
    )
    kinds = [event.what for event in wire_events(text.splitlines())]
    assert kinds == ["tx", "rx", "nothing", "rx", "tx", "clock"]


def test_a_line_that_is_none_is_refused() -> None:
    with pytest.raises(ValueError, match="no line of a wire log"):
        list(wire_events(["10 1? 02"]))


def played(text: str, *, numbered: bool = False) -> tuple[SerialLine, Playback]:
    line = SerialLine("socket://127.0.0.1:1")
    playback = Playback(wire_events(text.splitlines()))
    line.opener = playback.opener(1, numbered=numbered)
    line.open()
    return line, playback


def test_what_was_recorded_is_played_back() -> None:
    text = recorded(("tx", b"a"), ("rx", b"b"), ("nothing", b""), ("rx", b"c"), ("broken", b"it is gone"))
    line, playback = played(text)
    line.write(b"a")
    assert [line.read_some(0.0) for _ in range(3)] == [b"b", b"", b"c"]
    with pytest.raises(LinkLost, match="broke while reading: it is gone"):
        line.read_some(0.0)
    assert playback.clock() == 1.234567
    assert playback.is_over
    with pytest.raises(Departed, match="ends here, and the station looks at its clock"):
        playback.clock()


def test_whoever_asks_something_else_is_told_where() -> None:
    line, _ = played(recorded(("tx", b"a"), ("rx", b"b")))
    line.write(b"a")
    with pytest.raises(Departed, match="entry 2: line 1, rx 62"):
        line.write(b"c")


def test_frames_may_have_other_numbers_than_then() -> None:
    line, _ = played(
        recorded(("tx", b"\0\x07ask"), ("rx", b"\0\x07answer"), ("rx", b"\0\x06late")), numbered=True
    )
    line.write(b"\0\x01ask")
    assert line.read_some(0.0) == b"\0\x01answer"
    assert line.read_some(0.0) == b"\0\x06late"


def test_a_port_that_could_not_be_opened_cannot_be_opened() -> None:
    line = SerialLine("socket://127.0.0.1:1")
    playback = Playback(wire_events(recorded(("refused", b"LinkLost Nobody is there.")).splitlines()))
    line.opener = playback.opener(1, numbered=False)
    with pytest.raises(LinkLost, match="Nobody is there"):
        line.open()
