"""`/metrics`, read by the library's own parser."""

from __future__ import annotations

import json
import re
from datetime import UTC, datetime
from pathlib import Path

import pytest
from prometheus_client.openmetrics.parser import text_string_to_metric_families as open_families
from prometheus_client.parser import text_string_to_metric_families

from drivers.errors import LinkLost
from tests.waiting import soon
from tests.web.conftest import Service

Samples = dict[tuple[str, frozenset[tuple[str, str]]], float]
ROOT = Path(__file__).parents[2]
OPEN_METRICS = "application/openmetrics-text; version=1.0.0"


def scraped(service: Service) -> Samples:
    answer = service.client.get("/metrics")
    assert answer.status_code == 200
    assert answer.headers["content-type"].startswith("text/plain; version=")
    return {
        (sample.name, frozenset(sample.labels.items())): sample.value
        for family in text_string_to_metric_families(answer.text)
        for sample in family.samples
    }


def value(samples: Samples, name: str, **labels: str) -> float:
    return samples[name, frozenset(labels.items())]


def test_runs_readings_and_durations_are_counted(service: Service) -> None:
    run = service.complete()
    summary = service.client.get(f"/api/v1/calibrations/{run}").json()
    readings = len(service.client.get(f"/api/v1/calibrations/{run}/readings").json()["items"])
    samples = scraped(service)
    labels = {key: summary[key] for key in ("kind", "state", "outcome")}
    assert value(samples, "station_runs_total", **labels) == 1
    assert value(samples, "station_run_seconds_count", kind="calibrate") == 1
    assert value(samples, "station_readings_total") == readings > 0
    assert value(samples, "station_step_seconds_count") == readings - 1
    assert value(samples, "station_running") == 0
    assert value(samples, "station_store_bytes") > 0
    assert value(samples, "process_resident_memory_bytes") > 0


def test_stops_devices_and_clients_are_counted(service: Service) -> None:
    service.wait_for("scale read")
    service.rig.script.fail("scale read", LinkLost("scale: silent"))
    soon(lambda: service.device("scale")["state"] == "lost")
    service.client.post("/api/v1/stop")
    with service.client.websocket_connect("/api/v1/live") as live:
        live.receive_text()
        samples = scraped(service)
    assert value(samples, "station_stops_total", confirmed="yes") == 1
    assert value(samples, "station_live_clients") == 1
    assert value(samples, "station_device_up", device="scale") == 0
    assert value(samples, "station_device_errors_total", device="scale") >= 1
    assert value(samples, "station_device_up", device="axis 1") == 1


def test_what_waits_for_a_receiver_is_told(service: Service) -> None:
    store, receiver = service.runtime.store, "webhook https://mes.example/hook"
    store.enqueue(receiver, ("alarm",))
    store.announce("alarm", {"text": "test"})
    store.enqueue(receiver, ("alarm",))
    (backlog,) = store.backlogs()
    assert (backlog.receiver, backlog.count) == (receiver, 1)
    assert abs((datetime.now(UTC) - backlog.oldest_at).total_seconds()) < 60
    samples = scraped(service)
    assert value(samples, "station_deliveries_waiting", receiver="webhook https://mes.example/hook") == 1
    assert value(samples, "station_delivery_age_seconds", receiver="webhook https://mes.example/hook") < 60


def test_no_label_names_a_robot_a_run_or_a_person(service: Service) -> None:
    service.complete(robot_serial="FB-77", operator="carla", work_order="W-9")
    text = service.client.get("/metrics").text
    assert not [word for word in ("FB-77", "carla", "W-9") if word in text]


def test_a_scrape_neither_asks_a_device_nor_waits_for_the_rig(service: Service) -> None:
    service.hold()
    before = len(service.rig.script.calls)
    samples = scraped(service)
    looks = ("status", "feedback", "scale read")
    asked = [call for call in service.rig.script.calls[before:] if not call.endswith(looks)]
    assert asked == [], "only the worker's own looks at the axis that moves"
    assert value(samples, "station_running") == 1
    service.client.post("/api/v1/stop")


def test_a_history_that_cannot_be_read_is_a_metric(service: Service, monkeypatch: pytest.MonkeyPatch) -> None:
    from station.errors import StoreUnavailable

    def fails() -> None:
        raise StoreUnavailable("locked")

    monkeypatch.setattr(service.runtime.store, "backlogs", fails)
    assert value(scraped(service), "station_store_readable") == 0


def test_open_metrics_for_whoever_asks_for_it(service: Service) -> None:
    answer = service.client.get("/metrics", headers={"Accept": OPEN_METRICS})
    assert answer.headers["content-type"].startswith("application/openmetrics-text")
    families = open_families(answer.text)  # type: ignore[no-untyped-call]
    assert "station_runs" in {family.name for family in families}


def test_a_key_is_needed_where_the_station_is_not_open(closed: Service) -> None:
    assert closed.client.get("/metrics").status_code == 401
    assert closed.client.get("/metrics", headers=closed.key("viewer")).status_code == 200


def test_the_example_dashboard_asks_only_for_what_there_is(service: Service) -> None:
    service.complete()
    service.client.post("/api/v1/stop")
    text = service.client.get("/metrics").text
    known = {line.split()[2] for line in text.splitlines() if line.startswith("# TYPE")}
    known |= {sample.name for f in text_string_to_metric_families(text) for sample in f.samples}
    dashboard = json.loads((ROOT / "deploy/grafana-dashboard.json").read_text(encoding="utf-8"))
    asked = [target["expr"] for panel in dashboard["panels"] for target in panel["targets"]]
    names = {name for expression in asked for name in re.findall(r"station_\w+", expression)}
    assert len(names) >= 9 and names <= known
