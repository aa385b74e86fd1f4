"""The data folder. A separate module, so that `station --help` loads nothing else."""

from __future__ import annotations

import os
from pathlib import Path

import platformdirs


def station_home(option: Path | None) -> Path:
    """The folder for database, logs and backups: the option, STATION_HOME, or the platform's."""
    if option is not None:
        return option
    if named := os.environ.get("STATION_HOME"):
        return Path(named)
    return platformdirs.user_data_path("fivebar-station")
