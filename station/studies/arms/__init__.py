"""The closed loop on logs of random serial arms."""

from __future__ import annotations

from station.studies.arms.figures import figures
from station.studies.arms.one import Judged, arms

__all__ = ["Judged", "arms", "figures"]
