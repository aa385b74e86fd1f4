"""MQTT 5: each event at quality of service 1, and a retained topic with the state of the station.

`TOPIC/events/TYPE` contains the events; `TOPIC/state` is `online` after connecting and, by the broker's last
will, `offline` when the station has disappeared. `online` is repeated and expires: a station that disappears
while the broker is down has no last will.
"""

from __future__ import annotations

import threading
import time
from urllib.parse import unquote, urlsplit

import paho.mqtt.client as mqtt
from paho.mqtt.enums import CallbackAPIVersion, MQTTErrorCode
from paho.mqtt.packettypes import PacketTypes
from paho.mqtt.properties import Properties
from paho.mqtt.reasoncodes import ReasonCode

from station.outbox.receiver import Refused, body_of
from station.records import Event
from station.settings import MqttSettings

TIMEOUT_S = 10.0
KEEP_ALIVE_S = 20
LONGEST_WAIT_S = 60
REPEAT_S = 20.0
EXPIRES_S = 60
ONLINE, OFFLINE = "online", "offline"
_AGAIN = frozenset({"Unspecified error", "Implementation specific error", "Quota exceeded"})
"""Reasons for which the same event may be accepted later."""


class Mqtt:
    """A connection to one broker; the library reopens it automatically."""

    def __init__(self, settings: MqttSettings) -> None:
        self.name = f"mqtt {settings.topic} at {urlsplit(settings.url).hostname}"
        self.events: tuple[str, ...] = settings.events
        self._url = urlsplit(settings.url)
        self._state, self._topic = f"{settings.topic}/state", settings.topic
        self._connected = threading.Event()
        self._trouble = ""
        self._repeat_at_s = 0.0
        self._answers: dict[int, ReasonCode] = {}
        self._client: mqtt.Client | None = None

    def report_running(self) -> None:
        """Connect, now or as soon as the broker is available; repeat `online`."""
        client = self._client = self._client or self._connect()
        if self._connected.is_set() and time.monotonic() >= self._repeat_at_s:
            self._publish_online(client)

    def deliver(self, event: Event) -> str:
        """As `Receiver.deliver`: done when the broker has acknowledged it."""
        client = self._client = self._client or self._connect()
        if not self._connected.wait(TIMEOUT_S):
            raise OSError(self._trouble or "no connection to the broker")
        properties = Properties(PacketTypes.PUBLISH)  # type: ignore[no-untyped-call]
        properties.ContentType = "application/json"
        properties.UserProperty = [("id", event.uid)]
        self._answers.clear()
        sent = client.publish(f"{self._topic}/events/{event.type}", body_of(event), 1, properties=properties)
        if sent.rc != MQTTErrorCode.MQTT_ERR_SUCCESS:
            self.close()
            raise OSError(mqtt.error_string(sent.rc))
        sent.wait_for_publish(TIMEOUT_S)
        if not sent.is_published():
            self.close()
            raise TimeoutError("the broker did not acknowledge")
        return self._acknowledged(sent.mid)

    def _acknowledged(self, number: int) -> str:
        """A broker also acknowledges what it does not accept, with the reason."""
        reason = self._answers[number]
        if not reason.is_failure:
            return "acknowledged"
        text = f"the broker answers: {reason}"
        raise OSError(text) if str(reason) in _AGAIN else Refused(text)

    def _connect(self) -> mqtt.Client:
        client = mqtt.Client(CallbackAPIVersion.VERSION2, protocol=mqtt.MQTTv5)
        client.will_set(self._state, OFFLINE, qos=1, retain=True)
        if self._url.username:
            client.username_pw_set(unquote(self._url.username), unquote(self._url.password or ""))
        if self._url.scheme == "mqtts":
            client.tls_set()
        client.on_connect = self._on_connect
        client.on_disconnect = self._on_disconnect
        client.on_publish = self._on_publish
        port = self._url.port or (8883 if self._url.scheme == "mqtts" else 1883)
        client.connect_timeout = TIMEOUT_S
        client.reconnect_delay_set(1, LONGEST_WAIT_S)
        client.connect_async(self._url.hostname or "", port, KEEP_ALIVE_S)
        client.loop_start()
        return client

    def _on_connect(
        self, client: mqtt.Client, _data: object, _flags: object, reason: ReasonCode, _properties: object
    ) -> None:
        if reason.is_failure:
            self._trouble = f"the broker refuses the connection: {reason}"
            return
        self._trouble = ""
        self._publish_online(client)
        self._connected.set()

    def _on_disconnect(self, *_: object) -> None:
        self._connected.clear()

    def _on_publish(
        self, _client: mqtt.Client, _data: object, number: int, reason: ReasonCode, _properties: object
    ) -> None:
        self._answers[number] = reason

    def _publish_online(self, client: mqtt.Client) -> None:
        self._repeat_at_s = time.monotonic() + REPEAT_S
        properties = Properties(PacketTypes.PUBLISH)  # type: ignore[no-untyped-call]
        properties.MessageExpiryInterval = EXPIRES_S
        client.publish(self._state, ONLINE, qos=1, retain=True, properties=properties)

    def close(self) -> None:
        """Disconnect regularly; otherwise the broker sends the last will."""
        client, self._client = self._client, None
        if client is None:
            return
        if self._connected.is_set():
            client.publish(self._state, OFFLINE, qos=1, retain=True).wait_for_publish(1.0)
        client.disconnect()
        client.loop_stop()
        self._connected.clear()
