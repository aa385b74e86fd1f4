"""What the station forgets by rule: never a reading or a result, and never in silence."""

from __future__ import annotations

from contextlib import AbstractContextManager, nullcontext
from datetime import UTC, datetime, timedelta

from station.service.timer import Timer
from station.settings import RetentionSettings
from station.store import Store

EVERY_S = 24 * 3600.0


def retention_timer(store: Store, settings: RetentionSettings) -> AbstractContextManager[object]:
    """Applies the rules at the start and once a day."""
    days = settings.samples_days
    if days is None:
        return nullcontext()

    def apply() -> None:
        store.drop_samples(datetime.now(UTC) - timedelta(days=days))

    return Timer("retention", apply, EVERY_S)
