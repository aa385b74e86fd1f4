"""What travels between packages: readings, requests, results, measurement files."""

from __future__ import annotations

from station.records.guesses import guesses_in_words, with_guesses
from station.records.measurement_file import (
    FIVE_BAR,
    Columns,
    Table,
    approaches,
    parse_readings,
    read_measurements,
    read_table,
    readings_to_csv,
)
from station.records.measurements import Measurements, from_readings, number
from station.records.quantity import Quantity, vars_of
from station.records.reading import Reading
from station.records.run import (
    CalibrationRequest,
    CalibrationResult,
    PlanName,
    Procedure,
    Remembered,
    RunKind,
    SetZeros,
    State,
    Stop,
    Submitted,
    Walk,
    ZeroWrite,
)
from station.records.types import Angles, Complex, Index, Real
from station.records.visited import inside_visited, visited_in_degrees, visited_ranges

__all__ = [
    "FIVE_BAR",
    "Angles",
    "CalibrationRequest",
    "CalibrationResult",
    "Columns",
    "Complex",
    "Index",
    "Measurements",
    "PlanName",
    "Procedure",
    "Quantity",
    "Reading",
    "Real",
    "Remembered",
    "RunKind",
    "SetZeros",
    "State",
    "Stop",
    "Submitted",
    "Table",
    "Walk",
    "ZeroWrite",
    "approaches",
    "from_readings",
    "guesses_in_words",
    "inside_visited",
    "number",
    "parse_readings",
    "read_measurements",
    "read_table",
    "readings_to_csv",
    "vars_of",
    "visited_in_degrees",
    "visited_ranges",
    "with_guesses",
]
