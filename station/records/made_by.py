"""What measured a run: the software, the devices, and how the scale is traced to the metre."""

from __future__ import annotations

from datetime import date
from typing import Annotated

from pydantic import Field

from station.records.record import Record


class DeviceUsed(Record):
    """One device as the station file names it."""

    name: str
    driver: str
    address: str


class ScaleCertificate(Record):
    """The calibration certificate of the linear scale, as the station file states it."""

    scale: Annotated[str, Field(min_length=1, max_length=100)]
    """Serial number of the scale."""
    certificate: Annotated[str, Field(min_length=1, max_length=100)]
    """Number of its certificate."""
    laboratory: Annotated[str, Field(min_length=1, max_length=100)]
    """Who calibrated it."""
    calibrated: date
    """The day on which it was."""
    due: date
    """The last day on which it counts."""
    u95_um: Annotated[float, Field(ge=0, le=1000)]
    """Expanded uncertainty (k = 2) of a length, the part that does not depend on it, um."""
    u95_um_per_m: Annotated[float, Field(ge=0, le=10_000)] = 0.0
    """The part in proportion to the length, um/m."""
    expansion_ppm_per_k: Annotated[float, Field(ge=0, le=100)] = 10.0
    """Linear expansion of the scale."""
    temperature_c: Annotated[float, Field(ge=-20, le=80)] = 20.0
    """Of the scale at its place of work; readings that carry a temperature state their own."""
    temperature_within_k: Annotated[float, Field(ge=0, le=50)] = 5.0
    """The temperature lies within this of what is stated; every value is equally likely (GUM, 4.3.7)."""

    def counts_on(self, day: date) -> bool:
        """Whether a measurement of that day may rest on it."""
        return self.calibrated <= day <= self.due


class MadeBy(Record):
    """Kept with a run when it is created, and never changed."""

    station: str
    software: str
    """Version of this program."""
    libraries: dict[str, str]
    """Versions of what computes."""
    emulated: bool
    """No real machine was measured."""
    devices: tuple[DeviceUsed, ...] = ()
    scale_certificate: ScaleCertificate | None = None
    """None where the station file names none."""
