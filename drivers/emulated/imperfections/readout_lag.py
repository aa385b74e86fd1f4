"""Display that retains a part of its last value (outside the diagnosis's catalogue)."""

from typing import Literal

from pydantic import Field, PrivateAttr

from drivers.emulated.imperfections.base import Effect, LastStop, Scene


class ReadoutLag(Effect):
    """The display's filter is too slow: it retains `share` of the difference to the last stop's value."""

    kind: Literal["readout_lag"] = "readout_lag"
    share: float = Field(default=0.00015, ge=0, le=1)
    _last: LastStop = PrivateAttr(default_factory=LastStop)

    def on_head_mm(self, scene: Scene) -> float:
        before_mm = self._last.before(scene.stop, scene.travel_mm)
        return 0.0 if before_mm is None else self.share * (before_mm - scene.travel_mm)
