"""The closed loop on logs of random serial arms."""

from __future__ import annotations

from station.studies.arms.one import Judged, arms
from station.studies.arms.summary import figures

__all__ = ["Judged", "arms", "figures"]
