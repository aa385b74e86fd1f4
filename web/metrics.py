"""Counters and gauges of one service, for Prometheus.

Labels have few values and never name a robot, a run or a person. Counters restart with the process.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from prometheus_client import CollectorRegistry, Counter, Histogram, PlatformCollector, ProcessCollector
from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily
from prometheus_client.exposition import choose_encoder
from prometheus_client.metrics_core import Metric
from prometheus_client.registry import Collector

from station import __version__
from station.errors import StoreUnavailable
from station.motion import LiveEvent
from station.records import CalibrationSummary, DeviceDetail, RunReading
from station.service import Runtime

_RUN_BUCKETS_S = (1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1200, 1800, 3600)
_STEP_BUCKETS_S = (0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 60)


class Metrics:
    """Metrics of one running service; scraped from any thread."""

    def __init__(self, runtime: Runtime, clients: Callable[[], int]) -> None:
        """:param clients: number of clients of the live feed"""
        self._runtime = runtime
        self._registry = registry = CollectorRegistry()
        self._runs = Counter(
            "station_runs", "Runs that ended.", ("kind", "state", "outcome"), registry=registry
        )
        self._durations = Histogram(
            "station_run_seconds", "Duration of runs that ended.", ("kind",),
            buckets=_RUN_BUCKETS_S, registry=registry,
        )  # fmt: skip
        self._readings = Counter("station_readings", "Readings that were stored.", registry=registry)
        self._steps = Histogram(
            "station_step_seconds", "From one reading of a run to the next.",
            buckets=_STEP_BUCKETS_S, registry=registry,
        )  # fmt: skip
        self._stops = Counter("station_stops", "Quick stops.", ("confirmed",), registry=registry)
        self._last_reading_s: float | None = None
        registry.register(_Now(runtime, clients))
        ProcessCollector(registry=registry)
        PlatformCollector(registry=registry)

    def exposed(self, accept: str) -> tuple[str, bytes]:
        """Content type and text of all current values, in the format of the header `Accept`."""
        encode, content_type = choose_encoder(accept)
        return content_type, encode(self._registry)

    def stopped(self, *, confirmed: bool) -> None:
        """Count a stop request."""
        self._stops.labels("yes" if confirmed else "no").inc()

    @contextmanager
    def attached(self) -> Iterator[None]:
        """Count events while it is entered."""
        unsubscribe = self._runtime.orchestrator.subscribe(self._happened)
        try:
            yield
        finally:
            unsubscribe()

    def _happened(self, event: LiveEvent) -> None:
        match event.data:
            case RunReading() as reading:
                self._readings.inc()
                if self._last_reading_s is not None:
                    self._steps.observe(max(0.0, reading.t_s - self._last_reading_s))
                self._last_reading_s = reading.t_s
            case CalibrationSummary() as run:
                self._last_reading_s = None
                self._runs.labels(run.kind, run.state, run.outcome or "none").inc()
                if run.started_at is not None and run.ended_at is not None:
                    self._durations.labels(run.kind).observe((run.ended_at - run.started_at).total_seconds())


class _Now(Collector):
    """Values that are looked up at each scrape."""

    def __init__(self, runtime: Runtime, clients: Callable[[], int]) -> None:
        self._runtime, self._clients = runtime, clients

    def collect(self) -> Iterator[Metric]:
        yield GaugeMetricFamily("station_live_clients", "Clients of the live feed.", self._clients())
        running = self._runtime.orchestrator.running is not None
        yield GaugeMetricFamily("station_running", "1 while a run holds the rig.", int(running))
        info = GaugeMetricFamily("station_info", "The program.", labels=("version",))
        info.add_metric((__version__,), 1)
        yield info
        yield from _of_devices(self._runtime.orchestrator.device_details())
        yield from self._of_store()

    def _of_store(self) -> Iterator[Metric]:
        store = self._runtime.store
        size = sum(
            file.stat().st_size
            for file in (store.path, store.path.with_name(f"{store.path.name}-wal"))
            if file.exists()
        )
        yield GaugeMetricFamily("station_store_bytes", "The history on the disk, with its log.", size)
        up = GaugeMetricFamily("station_store_readable", "0 while the history cannot be read.")
        backlog = GaugeMetricFamily("station_deliveries_waiting", "Of each receiver.", labels=("receiver",))
        age = GaugeMetricFamily("station_delivery_age_seconds", "Oldest that waits.", labels=("receiver",))
        try:
            for waiting in store.backlogs():
                label = (waiting.receiver,)
                backlog.add_metric(label, waiting.count)
                age.add_metric(label, max(0.0, time.time() - waiting.oldest_at.timestamp()))
            up.add_metric((), 1)
        except StoreUnavailable:
            up.add_metric((), 0)
        yield from (up, backlog, age)


def _of_devices(devices: tuple[DeviceDetail, ...]) -> Iterator[Metric]:
    up = GaugeMetricFamily("station_device_up", "1 while the device answers.", labels=("device",))
    errors = CounterMetricFamily("station_device_errors", "Calls that failed.", labels=("device",))
    trip = GaugeMetricFamily(
        "station_device_round_trip_seconds", "Last reply on its line.", labels=("device",)
    )
    asked = CounterMetricFamily("station_device_requests", "Sent on its line.", labels=("device",))
    came = CounterMetricFamily("station_device_replies", "That came on its line.", labels=("device",))
    for device in devices:
        label = (device.name,)
        up.add_metric(label, int(device.state == "ok"))
        errors.add_metric(label, device.errors)
        asked.add_metric(label, device.requests)
        came.add_metric(label, device.replies)
        if device.round_trip_ms is not None:
            trip.add_metric(label, device.round_trip_ms / 1000)
    yield from (up, errors, trip, asked, came)
