"""The definition of an emulation: the machine's true errors, its speed, scripted wire faults."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import ConfigDict, Field

from drivers.emulated.imperfections import AnyEffect
from drivers.emulated.orders import FaultOrder
from drivers.strict_numbers import StrictNumbers

Pair = tuple[float, float]
Positive = Annotated[float, Field(gt=0)]


class _Table(StrictNumbers):
    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class MachineSpec(_Table):
    """A five-bar with its measuring mechanism; errors are actual minus nominal.

    Nominal values are Table 1 of the paper.  Index 0 is joint 1 (right), index 1 joint 2 (left).
    """

    seed: int = 1
    e_mm: tuple[Pair, Pair] = ((80.0, 0.0), (-80.0, 0.0))
    L_mm: tuple[Positive, Positive] = (375.0, 375.0)
    l_mm: tuple[Positive, Positive] = (825.0, 825.0)
    c_mm: Pair = (0.0, -79.0)
    d_mm: Pair = (0.0, -51.0)
    zero_offsets_deg: Pair = (0.0, 0.0)
    e_error_mm: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    """e_1x, e_1y, e_2x, e_2y."""
    L_error_mm: Pair = (0.0, 0.0)
    l_error_mm: Pair = (0.0, 0.0)
    drm_mm: Pair = (0.0, 0.0)
    """MAEMM: error of c + d."""
    head_zero_mm: float = 437.25
    """The unknown constant: the head reads rho less this."""
    counts_per_rev: int = Field(default=10_000, gt=0)
    ratio: Positive = 20.0
    zero_at_deg: Pair = (0.0, 180.0)
    sign: tuple[Literal[-1, 1], Literal[-1, 1]] = (1, 1)
    scale_noise_mm: float = Field(default=(3 + 0.35) / 3 * 1e-3, ge=0)
    """Standard deviation of a reading, eq. 34 of the paper."""
    scatter: bool = True
    """Whether the servos have a position error at rest, eq. 35 of the paper."""
    servo_error_pulses: float = Field(default=4.0, ge=0)
    """Largest error of a stop (three standard deviations), pulses."""
    whole_pulses: bool = True
    """Whether a servo stops on a pulse of its encoder (eq. 35 refers to pulse errors) or between two."""
    effects: tuple[AnyEffect, ...] = ()

    @property
    def pulses_per_deg(self) -> float:
        return self.counts_per_rev * self.ratio / 360.0


class EmulationSpec(_Table):
    """Settings for running the machine."""

    speed: Positive = 50.0
    """Speed of the arms over real time."""
    scale: Literal["heidenhain-nd", "siko"] = "heidenhain-nd"
    """Readout of the head."""
    scale_resolution_mm: Positive = 0.01
    """Resolution of a SIKO head."""
    servo: Literal["leadshine-el7", "leadshine-cs2rs", "orientalmotor"] = "leadshine-el7"
    """Family of the drives."""
    line: Literal["tcp", "rtu"] = "tcp"
    """Whether the drives are behind a Modbus TCP gateway, or the station is on their RS-485 line."""
    baud: Annotated[int, Field(ge=1200, le=1_000_000)] = 38_400
    """Baud rate of that line."""
    state_file: str | None = None
    """File with the drives' positions while the rig is off; none: they start at their zero."""


FaultKind = Literal[
    "scale_silent",
    "scale_garbled",
    "scale_fault_mark",
    "scale_late",
    "drive_silent",
    "drive_exception",
    "drive_late",
    "drive_alarm",
    "drive_never_in_position",
    "servo_link_dropped",
]


class Fault(_Table):
    """A fault on the wire that begins after `after` occasions and lasts for `times` of them.

    Occasions are value requests for `scale_...`, requests to the drive for `drive_silent`, `drive_exception`,
    `drive_late` and `servo_link_dropped`, moves for `drive_alarm` and `drive_never_in_position`.
    """

    kind: FaultKind
    joint: Literal[1, 2] | None = None
    """Number of the drive; none means either."""
    after: int = Field(default=0, ge=0)
    times: int = Field(default=1, gt=0)
    delay_s: float = Field(default=0.5, gt=0)
    """Delay of late replies."""
    code: int = Field(default=0, ge=0, le=0xFFFF)
    """Exception or alarm code; 0 selects a usual one."""


class RigSpec(_Table):
    """A rig file."""

    machine: MachineSpec = MachineSpec()
    emulated: EmulationSpec = EmulationSpec()
    faults: tuple[Fault, ...] = ()
    orders: tuple[FaultOrder, ...] = ()
    """Also written as `[[fault]]`, with `device`."""
