"""`[interlocks]` of the station file: conditions that must hold before and during motion, as data."""

from __future__ import annotations

from typing import Annotated, Any, Self

from pydantic import ConfigDict, Field, model_validator

from drivers.strict_numbers import StrictNumbers

Text = Annotated[str, Field(min_length=1, max_length=120)]


class InterlockSection(StrictNumbers):
    """The options of every interlock."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    text: Text | None = None
    """Text of the condition for users; by default, the text of the station in the language of the page."""


class AllDevicesAnswer(InterlockSection):
    """`[interlocks.devices]`: all devices answer."""


class DrivesAreReady(InterlockSection):
    """`[interlocks.drives]`: no drive has an alarm, and no drive loses its power during motion."""


class ArmIsInside(InterlockSection):
    """`[interlocks.workspace]`: the arm is inside its workspace when a run starts."""

    outside_mm: Annotated[float, Field(ge=0, le=200)] | None = None
    """Permitted distance outside the workspace; by default `[limits] swing_mm`."""


class ScaleReads(InterlockSection):
    """`[interlocks.scale]`: the scale gives a valid value."""


class ScaleTravels(InterlockSection):
    """`[interlocks.travel]`: the travel of the scale agrees with the joints, during motion and at each
    reading."""

    error_mm: Annotated[float, Field(gt=0, le=500)] | None = None
    """Permitted difference; by default `[limits] travel_error_mm`."""


class JointsFollow(InterlockSection):
    """`[interlocks.following_error]`: each joint follows its path and reaches its target."""

    error_deg: Annotated[float, Field(gt=0, le=10)] | None = None
    """Permitted deviation of a moving joint from its path; by default `[limits] corridor_deg`."""


class OnLineOfDrives(InterlockSection):
    """A value in a register of a device on the Modbus line of the drives: a drive or an input module."""

    unit: Annotated[int, Field(ge=1, le=247)]
    """Address of the drive or module on the line."""
    address: Annotated[int, Field(ge=0, le=0xFFFF)]
    """Address of the holding register, as on the wire."""


class GuardDoor(OnLineOfDrives):
    """`[interlocks.guard_door]`: a digital input shows that the guard door is closed.  Without this
    section there is no such input."""

    bit: Annotated[int, Field(ge=0, le=15)]
    """Bit of the register that is the input; 0 is the lowest."""
    closed: Annotated[int, Field(ge=0, le=1)] = 1
    """Value of the bit while the door is closed."""


class TemperatureWindow(OnLineOfDrives):
    """`[interlocks.temperature]`: a thermometer shows a temperature inside the permitted range.  Without this
    section there is no thermometer."""

    factor_c: Annotated[float, Field(gt=0, le=100)] = 0.1
    """Degrees Celsius per count of the register, which is signed."""
    low_c: Annotated[float, Field(ge=-100, le=300)]
    """Lowest temperature, degrees Celsius."""
    high_c: Annotated[float, Field(ge=-100, le=300)]
    """Highest temperature, degrees Celsius."""

    @model_validator(mode="after")
    def _is_a_window(self) -> Self:
        if self.low_c >= self.high_c:
            raise ValueError("low_c must be below high_c")
        return self


class ReferenceCheck(InterlockSection):
    """`[interlocks.reference_check]`: the last check of a reference robot has passed and is still valid
    (`[limits] check_valid_h`) when a run of another robot starts.  Without this section it is not checked."""

    robot: Annotated[str, Field(min_length=1, max_length=64)]
    """Serial number of the reference robot."""


class InterlockSettings(StrictNumbers):
    """`[interlocks]`: each interlock is a separate table. Omitted ones apply with their default limits."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    devices: AllDevicesAnswer = AllDevicesAnswer()
    drives: DrivesAreReady = DrivesAreReady()
    workspace: ArmIsInside = ArmIsInside()
    scale: ScaleReads = ScaleReads()
    travel: ScaleTravels = ScaleTravels()
    following_error: JointsFollow = JointsFollow()
    guard_door: GuardDoor | None = None
    temperature: TemperatureWindow | None = None
    reference_check: ReferenceCheck | None = None

    @property
    def reads_registers(self) -> bool:
        """Whether units other than the drives have to be queried."""
        return self.guard_door is not None or self.temperature is not None

    @model_validator(mode="before")
    @classmethod
    def _names_are_known(cls, data: Any) -> Any:
        unknown = sorted(set(data) - set(cls.model_fields)) if isinstance(data, dict) else []
        if unknown:
            known = ", ".join(cls.model_fields)
            raise ValueError(f'there is no interlock "{unknown[0]}"; there is {known}')
        return data
