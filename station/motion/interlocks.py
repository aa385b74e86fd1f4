"""Interlocks: conditions for motion, before and during it, each with its limits, state and last trip."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from datetime import UTC, datetime

from drivers.errors import DeviceError
from station.errors import StepFailed
from station.interlock_settings import InterlockSettings, OnLineOfDrives
from station.records import CalibrationHolds, Interlock, Trip
from station.settings import LimitSettings

ReadRegister = Callable[[int, int], int]
"""A holding register of a unit on the line of the drives.  :raises DeviceError:"""
_TEXTS = {
    "devices": "All devices answer",
    "drives": "Both drives are ready",
    "workspace": "The arm stands within its workspace",
    "scale": "The scale reads",
    "travel": "The scale moves as far as the joints say",
    "following_error": "Each joint keeps to its way",
    "guard_door": "The guard door is closed",
    "temperature": "The temperature is within its window",
    "reference_check": "The reference check is valid",
}


class Tripped(StepFailed):
    """An interlock was violated during motion."""

    def __init__(self, interlock: str, text: str) -> None:
        super().__init__(text)
        self.interlock = interlock
        self.noticed_at_s = time.monotonic()


class Interlocks:
    """The interlocks of the station file, and defaults. One thread evaluates them; any may read them."""

    def __init__(
        self,
        declared: InterlockSettings,
        limits: LimitSettings,
        read_register: ReadRegister | None,
        reference: Callable[[str], CalibrationHolds] | None = None,
    ) -> None:
        """:param read_register: None if the drives are on no line with registers

        :param reference: result of the checks of a robot; None: not used
        """
        self._declared, self._limits = declared, limits
        self._read_register = read_register
        self._reference = reference
        self._reference_state: CalibrationHolds | None = None
        self._details: dict[str, str] = {}
        self._broken: dict[str, str] = {}
        """Violated during motion; until nothing moves."""
        self._shows: dict[str, str] = {}
        self._last_trips: dict[str, Trip] = {}
        self.forget()

    # Limits ---------------------------------------------------------------------------------------

    @property
    def outside_mm(self) -> float:
        """How far outside its workspace the arm may be when a run starts."""
        own = self._declared.workspace.outside_mm
        return self._limits.swing_mm if own is None else own

    @property
    def travel_error_mm(self) -> float:
        """Allowed difference between the travel of the scale and the joints."""
        return self._declared.travel.error_mm or self._limits.travel_error_mm

    @property
    def following_error_deg(self) -> float:
        """Allowed deviation of a moving joint from its path."""
        return self._declared.following_error.error_deg or self._limits.corridor_deg

    # Evaluation ---------------------------------------------------------------------------------

    def trip(self, interlock: str, text: str) -> Tripped:
        """The error for an interlock that was violated during motion, to be raised."""
        self._broken[interlock] = text
        return Tripped(interlock, text)

    def hold_again(self) -> None:
        """At standstill, interlocks violated by a motion count as satisfied until the next one."""
        self._broken.clear()

    def forget(self) -> None:
        """The line of the drives is down: an unknown condition counts as violated."""
        for interlock in ("guard_door", "temperature"):
            self._judge(interlock, "not known while the drives do not answer")
        self._shows.clear()

    def look_at_guard_door(self) -> str:
        """Read its input; returns the trouble, or empty. Without such an input there is none."""
        door = self._declared.guard_door
        if door is None:
            return ""
        value = self._read(door)
        if isinstance(value, int):
            closed = (value >> door.bit & 1) == door.closed
            value = "" if closed else f"input {door.bit} of unit {door.unit} says that it is open"
        return self._judge("guard_door", value)

    def look_at_temperature(self) -> str:
        """Read the thermometer; as `look_at_guard_door`."""
        window = self._declared.temperature
        if window is None:
            return ""
        value = self._read(window)
        if isinstance(value, int):
            shown_c = (value - 0x10000 if value & 0x8000 else value) * window.factor_c
            self._shows["temperature"] = f"{shown_c:.1f} °C"
            inside = window.low_c <= shown_c <= window.high_c
            allowed = f"{window.low_c:g} to {window.high_c:g} °C are allowed"
            value = "" if inside else f"{shown_c:.1f} °C, {allowed}"
        return self._judge("temperature", value)

    def look_at_reference(self) -> None:
        """Look up in the history the result of the reference robot's checks."""
        wanted = self._declared.reference_check
        if wanted is not None and self._reference is not None:
            self._reference_state = self._reference(wanted.robot)

    def _read(self, where: OnLineOfDrives) -> int | str:
        """The register, or why it cannot be read: an unknown condition counts as violated."""
        if self._read_register is None:
            return "the drives of this station are on no line with registers"
        try:
            return self._read_register(where.unit, where.address)
        except DeviceError as error:
            return f"it cannot be read: {error}".rstrip(".")

    def _judge(self, interlock: str, trouble: str) -> str:
        self._details[interlock] = trouble
        return trouble

    def _reference_trouble(self, serial: str) -> str:
        """Why a robot other than the reference robot may not be run."""
        wanted, state = self._declared.reference_check, self._reference_state
        if wanted is None or self._reference is None or wanted.robot == serial:
            return ""
        if state is None:
            return f"the checks of reference robot {wanted.robot} are not known yet"
        if state.locked:
            return f"reference robot {wanted.robot}: {state.text}".rstrip(".")
        until = state.calibration_valid_until
        if until is None:
            return f"reference robot {wanted.robot} has not passed a check since it was calibrated"
        if datetime.now(UTC) > until:
            return (
                f"the last check of reference robot {wanted.robot} was valid until {until:%Y-%m-%d %H:%M} UTC"
            )
        return ""

    # State --------------------------------------------------------------------------------------

    def ended(self, tripped: Tripped, trip: Trip) -> None:
        """The motion that an interlock ended has come to standstill."""
        self._last_trips[tripped.interlock] = trip

    def views(self, known: Mapping[str, str], serial: str) -> tuple[Interlock, ...]:
        """All declared interlocks.

        :param known: trouble, or empty, by the names of the interlocks that the machine evaluates at any time
        :param serial: serial of the robot on the rig
        """
        now = {**self._details, **known, "reference_check": self._reference_trouble(serial)}
        broken = dict(self._broken)
        return tuple(
            self._view(name, now.get(name) or broken.get(name, ""))
            for name in InterlockSettings.model_fields
            if getattr(self._declared, name) is not None
        )

    def _view(self, name: str, detail: str) -> Interlock:
        own_text: str | None = getattr(self._declared, name).text
        return Interlock(
            id=name,
            text=own_text or _TEXTS[name],
            ok=not detail,
            detail=detail,
            own_text=own_text is not None,
            limits=self._limits_of(name),
            shows=self._shows.get(name, ""),
            last_trip=self._last_trips.get(name),
        )

    def _limits_of(self, name: str) -> dict[str, float]:
        match name:
            case "workspace":
                return {"outside_mm": self.outside_mm}
            case "travel":
                return {"error_mm": self.travel_error_mm}
            case "following_error":
                return {"error_deg": self.following_error_deg}
            case "temperature" if (window := self._declared.temperature) is not None:
                return {"low_c": window.low_c, "high_c": window.high_c}
        return {}
