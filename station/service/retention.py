"""Deletion of data by rule: never a reading or a result, and always recorded."""

from __future__ import annotations

from contextlib import AbstractContextManager, nullcontext
from datetime import UTC, datetime, timedelta

from station.service.timer import Timer
from station.settings import RetentionSettings
from station.store import Store

EVERY_S = 24 * 3600.0


def retention_timer(store: Store, settings: RetentionSettings) -> AbstractContextManager[object]:
    """Applies the rules at the start and once a day."""
    rules = [
        (days, drop)
        for days, drop in (
            (settings.samples_days, store.drop_samples),
            (settings.wire_days, store.drop_wire),
        )
        if days is not None
    ]
    if not rules:
        return nullcontext()

    def apply() -> None:
        for days, drop in rules:
            drop(datetime.now(UTC) - timedelta(days=days))

    return Timer("retention", apply, EVERY_S)
