"""What every drive on a Modbus line has in common."""

from __future__ import annotations

from drivers.lines import ModbusBus, OnLine

_BUDGET_S = 0.4
"""For one repetition: while a sensor is asked in motion, nothing else is watched."""


class OnBus(OnLine):
    """A drive on a bus; also a `RegisterReader` for what else is on it."""

    def __init__(self, bus: ModbusBus) -> None:
        super().__init__(bus.line)
        self._bus = bus

    def read_register(self, unit: int, address: int) -> int:
        """One holding register of a unit on the line, 0..65535.  :raises DeviceError:"""
        return self._bus.read(unit, address, 1, budget_s=_BUDGET_S)[0]
