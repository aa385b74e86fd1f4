"""Webhooks, signed as Standard Webhooks 1.0 describes (https://www.standardwebhooks.com).

`webhook-id` is the event's uid, so that a receiver recognises a repetition.
"""

from __future__ import annotations

import base64
import binascii
import hashlib
import hmac
import ssl
import time
from collections.abc import Callable
from pathlib import Path

from station.errors import InputRefused
from station.outbox.receiver import Refused, body_of
from station.records import Event
from station.settings import WebhookSettings

PREFIX = "whsec_"
FEWEST_BYTES = 24
TIMEOUT_S = 15.0
_AGAIN = (408, 429)
_MOST_READ = 65_536


def secret_of(path: Path) -> bytes:
    """The key in a file: base64 after `whsec_`.  :raises InputRefused: there is none, or it is too short."""
    try:
        text = path.read_text(encoding="utf-8").strip()
        key = base64.b64decode(text.removeprefix(PREFIX), validate=True)
    except OSError as error:
        raise InputRefused(f"The secret of a webhook, {path}, cannot be read: {error.strerror}.") from error
    except (UnicodeDecodeError, binascii.Error) as error:
        raise InputRefused(f"The secret in {path} must be `{PREFIX}` and base64.") from error
    if len(key) < FEWEST_BYTES:
        raise InputRefused(f"The secret in {path} has {len(key)} bytes; it needs {FEWEST_BYTES} or more.")
    return key


def signature(key: bytes, uid: str, timestamp: int, body: bytes) -> str:
    """HMAC-SHA256 over id, timestamp and body, in the form of the header `webhook-signature`."""
    signed = b".".join((uid.encode(), str(timestamp).encode(), body))
    return f"v1,{base64.b64encode(hmac.digest(key, signed, hashlib.sha256)).decode()}"


class Webhook:
    """One address that events are posted to."""

    def __init__(self, settings: WebhookSettings, *, clock: Callable[[], float] = time.time) -> None:
        """:raises InputRefused: its secret cannot be used."""
        # a query may contain a token: the name is shown, logged and stored
        self.name = f"webhook {settings.url.partition('?')[0]}"
        self.events: tuple[str, ...] = settings.events
        self._url = settings.url
        self._key = secret_of(settings.secret_file)
        self._clock, self._trust = clock, ssl.create_default_context()

    def report_running(self) -> None:
        """Nothing to do."""

    def deliver(self, event: Event) -> str:
        """As `Receiver.deliver`; a redirection is not followed, since it would send the event elsewhere."""
        body, timestamp = body_of(event), int(self._clock())
        headers = {
            "Content-Type": "application/json",
            "User-Agent": "fivebar-station",
            "webhook-id": event.uid,
            "webhook-timestamp": str(timestamp),
            "webhook-signature": signature(self._key, event.uid, timestamp, body),
        }
        # imported here: only stations with a webhook need it
        from httpx2 import Client

        with (
            Client(timeout=TIMEOUT_S, verify=self._trust, trust_env=False) as client,
            client.stream("POST", self._url, content=body, headers=headers) as answer,
        ):
            said = f"{answer.status_code} {answer.reason_phrase}".strip()
            read = 0
            for part in answer.iter_raw():  # a truncated answer is not valid
                read += len(part)
                if read > _MOST_READ:
                    break
        if 200 <= answer.status_code < 300:
            return said
        if 400 <= answer.status_code < 500 and answer.status_code not in _AGAIN:
            raise Refused(said)
        raise OSError(f"answered {said}")

    def close(self) -> None:
        """Nothing to close."""
