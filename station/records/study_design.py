"""The number of calibrations of one robot in a gauge study."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from station.records.sections import Section

Times = Annotated[int, Field(ge=2, le=10)]


class StudyDesign(Section):
    """Every operator mounts the mechanism several times; each mounting is calibrated several times."""

    operators: Times = 3
    mountings: Times = 2
    """Mountings of each operator."""
    repeats: Times = 2
    """Calibrations with each mounting."""

    @property
    def all_mountings(self) -> int:
        return self.operators * self.mountings

    def operator_of(self, mounting: int) -> int:
        """The operator 1, 2, ... of mounting 0, 1, ...: in turn, so that a drift affects all equally."""
        return mounting % self.operators + 1

    def sequence_of(self, mounting: int, repeat: int) -> int:
        """Number of the measurement sequence of mounting 0, 1, ... and repeat 0, 1, ..."""
        return mounting * self.repeats + repeat + 1
