"""Collects the events of many stations from an MQTT broker into Parquet files.

`python collector.py mqtt://broker:1883 FOLDER`; the stations publish below `stations/NAME` (their option
`topic`).  An event is acknowledged to the broker only when its file is on the disk, so none is lost; one that
comes twice has the same `event_uid`.
"""

from __future__ import annotations

import json
import os
import signal
import sys
import threading
import time
import uuid
from datetime import UTC, datetime
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlsplit

import paho.mqtt.client as mqtt
import pyarrow as pa
import pyarrow.parquet as pq
from paho.mqtt.enums import CallbackAPIVersion
from paho.mqtt.packettypes import PacketTypes
from paho.mqtt.properties import Properties

TOPIC = "stations/+/events/#"
NAME = "fleet-collector"
"""Client id: the broker keeps this session while the collector is not connected."""
WEEK_S = 7 * 86_400
WRITE_EVERY_S = 10.0
COLUMNS = {
    "event_uid": pa.string(),
    "station": pa.string(),
    "type": pa.string(),
    "at": pa.timestamp("ms", tz="UTC"),
    "run_uid": pa.string(),
    "run": pa.int64(),
    "robot_serial": pa.string(),
    "kind": pa.string(),
    "outcome": pa.string(),
    "zero1_deg": pa.float64(),
    "zero2_deg": pa.float64(),
    "data": pa.string(),
}
SCHEMA = pa.schema(list(COLUMNS.items()))


class Collector:
    """Messages wait here until they are written."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._lock = threading.Lock()
        self._waiting: list[mqtt.MQTTMessage] = []

    def take(self, client: mqtt.Client, _data: Any, message: mqtt.MQTTMessage) -> None:
        """One message of the broker."""
        with self._lock:
            self._waiting.append(message)

    def write(self, client: mqtt.Client) -> int:
        """Everything that waits becomes one file for each day; then the broker is told.  How many rows."""
        with self._lock:
            messages, self._waiting = self._waiting, []
        days: dict[str, list[dict[str, Any]]] = {}
        for message in messages:
            if (row := row_of(message)) is not None:
                days.setdefault(f"{row['at']:%Y-%m-%d}", []).append(row)
        for day, rows in days.items():
            _keep(self._folder / f"day={day}", pa.Table.from_pylist(rows, SCHEMA))
        for message in messages:
            client.ack(message.mid, message.qos)
        return sum(map(len, days.values()))


def row_of(message: mqtt.MQTTMessage) -> dict[str, Any] | None:
    """A row of the table; None if the message is not an event of a station."""
    try:
        event = json.loads(message.payload)
        data = event["data"]
        at = datetime.fromisoformat(event["timestamp"]).astimezone(UTC)
        uid = dict(message.properties.UserProperty)["id"]
        zeros = {zero["joint"]: zero["value_deg"] for zero in data.get("zero_offsets") or ()}
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        print(f"{message.topic}: no event of a station: {error!r}", file=sys.stderr)
        return None
    return {
        "event_uid": uid,
        "station": message.topic.split("/")[1],
        "type": event["type"],
        "at": at,
        "run_uid": data.get("uid"),
        "run": data.get("id"),
        "robot_serial": data.get("robot_serial"),
        "kind": data.get("kind"),
        "outcome": data.get("outcome"),
        "zero1_deg": zeros.get(1),
        "zero2_deg": zeros.get(2),
        "data": json.dumps(data),
    }


def _keep(folder: Path, table: pa.Table) -> None:
    """On the disk as a whole, or not at all."""
    folder.mkdir(parents=True, exist_ok=True)
    name = uuid.uuid4().hex
    draft = folder / f".{name}.part"
    pq.write_table(table, draft)
    with draft.open("rb") as file:
        os.fsync(file.fileno())
    draft.rename(folder / f"{name}.parquet")


def connected(url: str, collector: Collector) -> mqtt.Client:
    """To the broker, now or as soon as it is there."""
    address = urlsplit(url)
    client = mqtt.Client(CallbackAPIVersion.VERSION2, client_id=NAME, protocol=mqtt.MQTTv5, manual_ack=True)
    if address.username:
        client.username_pw_set(unquote(address.username), unquote(address.password or ""))
    if address.scheme == "mqtts":
        client.tls_set()
    client.on_connect = lambda client, *_: client.subscribe(TOPIC, qos=1)
    client.on_message = collector.take
    session = Properties(PacketTypes.CONNECT)
    session.SessionExpiryInterval = WEEK_S
    client.connect_async(
        address.hostname or "localhost", address.port or 1883, clean_start=False, properties=session
    )
    return client


def main() -> int:
    """Until it is told to end."""
    if len(sys.argv) != 3:
        print("Usage: collector.py mqtt://HOST:PORT FOLDER", file=sys.stderr)
        return 2
    collector = Collector(Path(sys.argv[2]))
    ending = threading.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: ending.set())
    client = connected(sys.argv[1], collector)
    client.loop_start()
    every_s = float(os.environ.get("WRITE_EVERY_S", WRITE_EVERY_S))
    while not ending.wait(every_s):
        if rows := collector.write(client):
            print(f"{time.strftime('%F %T')} {rows} events", flush=True)
    collector.write(client)
    client.disconnect()
    client.loop_stop()
    return 0


if __name__ == "__main__":
    sys.exit(main())
