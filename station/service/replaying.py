"""A run repeated from its wire log: the same drivers, clock and memory, without a machine."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import closing, contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from drivers.errors import DeviceError
from drivers.lines import Departed, Playback, wire_events
from station.errors import InputRefused, StepFailed
from station.motion import Listeners, Machine, PlayedClock, build_devices
from station.records import CalibrationRequest, State, WireHeader, because
from station.run_kinds import RUN_KINDS, request_of
from station.service.carrying_out import CarryingOut
from station.service.recording import SERVO, lines_of
from station.service.run import Run
from station.settings import Settings
from station.store import Store, found, rewind

_NUMBERED = "modbus+tcp://"


@dataclass(frozen=True, slots=True)
class Replayed:
    """The result of a replay."""

    readings: int
    """Number of readings that are identical to the bit."""
    of: int
    """Number of readings recorded."""
    same_end: bool
    """Whether verdict, reason, result and diagnosis are identical to the bit."""
    departed: str = ""
    """Where the station acted differently from the log; empty if it did not."""

    @property
    def same(self) -> bool:
        """Whether everything is identical."""
        return self.same_end and self.readings == self.of and not self.departed


def replay(store: Store, run: int) -> Replayed:
    """Repeat a run from its wire log, on a copy of the history as it was when the run began.

    :raises NotFound: no such run, or no wire log of it is stored.
    :raises InputRefused: it did not end by itself, or its samples are no longer stored.
    """
    summary = store.summary(run)
    if summary.state not in (State.SUCCEEDED, State.FAILED):
        raise InputRefused(
            f"Run {run} was {summary.state}: only a run that ended by itself can be replayed to its end;"
            f" `station wire {run}` prints what was recorded."
        )
    header_text, *lines = store.wire_log(run)
    header = WireHeader.model_validate_json(header_text)
    with _copy_before(store, run) as copy:
        playback, request = Playback(wire_events(lines)), request_of(store, run)
        departed = _carry_out(copy, run, header, playback, request, _answers(store, run))
        then, now = found(store.opened, run), found(copy.path, run)
    same = sum(a == b for a, b in zip(then[0], now[0], strict=False))
    return Replayed(same, len(then[0]), then[1] == now[1] and len(then[0]) == len(now[0]), departed)


@contextmanager
def _copy_before(store: Store, run: int) -> Iterator[Store]:
    with TemporaryDirectory() as folder:
        path = Path(folder) / "station.db"
        store.backup(path)
        rewind(path, run)
        with closing(Store(path)) as copy:
            yield copy


def _answers(store: Store, run: int) -> list[float | None]:
    """Answers to the run's prompts, in order."""
    values = [event.data.get("value") for event in store.events(run) if event.kind == "answer"]
    return [float(value) if isinstance(value, int | float) else None for value in values]


def _carry_out(
    copy: Store,
    run: int,
    header: WireHeader,
    playback: Playback,
    request: CalibrationRequest,
    answers: Sequence[float | None],
) -> str:
    """Repeat it to its end in the copy; returns where the station departed from the log, otherwise empty."""
    settings = Settings.model_validate(
        {
            "scale": header.scale,
            "servo": header.servo,
            "limits": header.limits,
            "interlocks": header.interlocks,
        }
    )
    devices = build_devices(settings, speed=header.speed)
    for number, line in lines_of(devices).items():
        numbered = number == SERVO and str(header.servo["url"]).startswith(_NUMBERED)
        line.opener = playback.opener(number, numbered=numbered)
    machine = Machine(devices, settings.limits, Listeners(), settings.interlocks)
    kind = RUN_KINDS[request.kind]
    carrying_out = CarryingOut(
        Run(run, copy.summary(run).uid, request, copy.robot_of(run).informed(request.references)),
        kind,
        machine,
        copy,
        settings,
        Listeners(),
        lambda _elapsed_s: PlayedClock(playback.clock),
        bytes,
        iter(answers),
    )
    try:
        result = carrying_out.result()
    except (DeviceError, StepFailed, InputRefused) as error:
        copy.finish(run, State.FAILED, None, because("step_failed", text=str(error)), judged=kind.judged)
    except Departed as error:
        return str(error)
    else:
        copy.finish(run, State.SUCCEEDED, result if kind.judged else None, result.reason, judged=kind.judged)
    return ""
