"""The document of `station identify --json` (schema station.identification/1)."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from station.records.accuracy import PositionError, WeakDirection
from station.records.diagnosis_document import DataSource, NoiseOfReadings
from station.records.phrases import Phrase
from station.records.quantity import Quantity
from station.records.record import Record
from station.records.references import ReferenceUse
from station.records.result import ZeroOffset


class OutlierNote(Record):
    """An excluded reading, and the reason."""

    reading: int | str
    residual_mm: float
    reason: str
    said: Phrase | None = None
    """The reason by its code, for other languages; null in documents of older versions."""


class ResidualSummary(Record):
    """The residual of the readings under the model."""

    rms_mm: float
    max_mm: float
    lack_of_fit_p: float
    adequate: bool


class PredictedAccuracy(Record):
    """Position error over the workspace; null for a machine without a declared workspace."""

    predicted_position_error_mm: PositionError | None


class PositionErrorAt(Record):
    """Predicted position error at one position, before and after compensation."""

    x_mm: float
    y_mm: float
    before_mm: float
    after_mm: float


class GateOfMemory(Record):
    """Whether the knowledge from earlier calibrations was used, and how well the readings agree with it."""

    used: bool
    p_value: float
    text: str
    said: Phrase | None = None
    """The text by its code, for other languages; null in documents of older versions."""


class Convergence(Record):
    """How the solver ended."""

    steps: int
    status: Literal["converged", "slow", "rounding", "stopped"] = "converged"
    """All except `stopped` reached the minimum."""
    message: str = "converged"
    gain_left: float = 0.0
    """Reduction of the cost that one more step would give."""


class JumpNote(Record):
    """A jump between two readings: of the readout, or of a joint's zero."""

    reading: int | str
    """The first reading after it."""
    thing: Literal["readout", "joint 1", "joint 2"] | None
    """null: the readings do not determine which."""
    size_mm: float | None = None
    size_deg: float | None = None
    text: str


class IdentificationDocument(Record):
    """All results of one fit of the measurement model."""

    schema_: Annotated[Literal["station.identification/1"], Field(alias="schema")] = (
        "station.identification/1"
    )
    data: DataSource | None = None
    method: str = "measurement model"
    noise: NoiseOfReadings
    zero_offsets: tuple[ZeroOffset, ...]
    modes: tuple[Quantity, ...]
    """For a five-bar, half the sum and half the difference of the zero offsets."""
    parameters: tuple[Quantity, ...]
    coverage_factor: float
    """k of the 95 % interval."""
    weak_direction: WeakDirection
    singular_values: tuple[float, ...]
    residual: ResidualSummary
    sd_factor: float
    """Factor on the uncertainties where the model does not fit; 1 when it does."""
    before: PredictedAccuracy
    after: PredictedAccuracy
    position_error_map: tuple[PositionErrorAt, ...]
    outliers: tuple[OutlierNote, ...]
    jump: JumpNote | None = None
    """If not null, the zero offsets are not those of the present machine, and `adequate` is false."""
    references: tuple[ReferenceUse, ...] = ()
    """References from other instruments, and how well they agree with the other data."""
    memory: GateOfMemory | None
    convergence: Convergence
