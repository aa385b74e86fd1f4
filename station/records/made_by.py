"""The source of a run: software, devices, and the traceability of the scale."""

from __future__ import annotations

from datetime import date
from typing import Annotated

from pydantic import Field

from station.records.record import Record


class DeviceUsed(Record):
    """One device as in the station file."""

    name: str
    driver: str
    address: str


class ScaleCertificate(Record):
    """The calibration certificate of the linear scale, as in the station file."""

    scale: Annotated[str, Field(min_length=1, max_length=100)]
    """Serial number of the scale."""
    certificate: Annotated[str, Field(min_length=1, max_length=100)]
    """Number of its certificate."""
    laboratory: Annotated[str, Field(min_length=1, max_length=100)]
    """Laboratory that calibrated it."""
    calibrated: date
    """Day of the calibration."""
    due: date
    """Last day of its validity."""
    u95_um: Annotated[float, Field(ge=0, le=1000)]
    """Expanded uncertainty (k = 2) of a length, the part independent of the length, um."""
    u95_um_per_m: Annotated[float, Field(ge=0, le=10_000)] = 0.0
    """The part proportional to the length, um/m."""
    expansion_ppm_per_k: Annotated[float, Field(ge=0, le=100)] = 10.0
    """Linear expansion of the scale."""
    temperature_c: Annotated[float, Field(ge=-20, le=80)] = 20.0
    """Temperature of the scale in operation; readings with a temperature state their own."""
    temperature_within_k: Annotated[float, Field(ge=0, le=50)] = 5.0
    """The temperature is within this of the stated value; every value is equally likely (GUM, 4.3.7)."""

    def counts_on(self, day: date) -> bool:
        """Whether it is valid for a measurement on that day."""
        return self.calibrated <= day <= self.due


class MadeBy(Record):
    """Stored with a run when it is created, and never changed."""

    station: str
    software: str
    """Version of this program."""
    libraries: dict[str, str]
    """Versions of the numerical libraries."""
    emulated: bool
    """No real machine was measured."""
    devices: tuple[DeviceUsed, ...] = ()
    scale_certificate: ScaleCertificate | None = None
    """None if the station file names none."""
