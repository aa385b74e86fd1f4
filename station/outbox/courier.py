"""Delivers the events of the store to one receiver: in order, at least once, over restarts.

A failed delivery is tried again after 1, 2, 4, ... at most 60 s, and no other overtakes it. Events that the
receiver refuses permanently, and too old or too many ones, are marked and do not delay the others.
"""

from __future__ import annotations

import logging
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager
from datetime import UTC, datetime, timedelta
from threading import Event as Flag
from threading import Thread

from station.errors import InputRefused, StoreUnavailable
from station.outbox.folder import Folder
from station.outbox.mqtt import Mqtt
from station.outbox.receiver import Receiver, Refused
from station.outbox.trouble import in_words
from station.outbox.webhook import Webhook
from station.settings import OutboxSettings
from station.store import Store

log = logging.getLogger(__name__)

LONGEST_WAIT_S = 60.0
_TRIES_A_DAY = 86_400 / LONGEST_WAIT_S
_BEFORE_ALL = datetime.min.replace(tzinfo=UTC)
LOOK_S = 0.5
"""Interval at which new events are detected."""


def _now() -> datetime:
    return datetime.now(UTC)


class Courier:
    """The courier of one receiver."""

    def __init__(
        self, store: Store, receiver: Receiver, settings: OutboxSettings, now: Callable[[], datetime] = _now
    ) -> None:
        self.receiver = receiver
        self._store, self._settings, self._now = store, settings, now
        self._closing = Flag()
        self._thread = Thread(target=self._run, name=f"courier to {receiver.name}", daemon=True)

    def step(self) -> float:
        """Deliver at most one due event; returns the seconds until the next call.

        :raises StoreUnavailable:
        """
        name, now = self.receiver.name, self._now()
        self._store.enqueue(name, self.receiver.events)
        if (found := self._store.next_delivery(name)) is None:
            return LOOK_S
        delivery, event = found
        wait_s = (delivery.next_at - now).total_seconds() if delivery.next_at is not None else 0.0
        if 0.0 < wait_s <= LONGEST_WAIT_S:  # a longer wait was never set: the clock was set back
            return min(wait_s, LOOK_S)
        if dropped := self._drop(now, delivery.tries):
            log.error("%s: %d events were given up, too old or too many", name, dropped)
            return 0.0
        try:
            said = self.receiver.deliver(event)
        except Refused as refusal:
            log.error("%s refuses event %d for good: %s", name, event.n, refusal)
            self._store.settle(delivery.id, "refused", str(refusal)[:300])
        except Exception as error:  # noqa: BLE001 - whatever goes wrong on the way, it is tried again
            wait_s = min(2.0**delivery.tries, LONGEST_WAIT_S)
            why = in_words(error)
            log.warning("%s: event %d is tried again in %g s: %s", name, event.n, wait_s, why)
            self._store.postpone(delivery.id, self._now() + timedelta(seconds=wait_s), why[:300])
        else:
            self._store.settle(delivery.id, "delivered", said[:300])
        return 0.0

    def _drop(self, now: datetime, tries: int) -> int:
        """Give up excess events, and too old ones once the first has been tried for that time.

        The clock alone gives up no event: it may have been set forward, or the station was off.
        """
        oldest = _BEFORE_ALL
        if tries >= self._settings.keep_days * _TRIES_A_DAY:
            oldest = now - timedelta(days=self._settings.keep_days)
        return self._store.expire(self.receiver.name, oldest, self._settings.keep)

    def _run(self) -> None:
        wait_s = 0.0
        while not self._closing.wait(wait_s):
            self.receiver.report_running()
            try:
                wait_s = self.step()
            except StoreUnavailable as error:
                log.error("%s: %s", self._thread.name, error)
                wait_s = LONGEST_WAIT_S / 10
        self.receiver.close()

    @contextmanager
    def working(self) -> Iterator[None]:
        """Runs on its own thread; a delivery in progress at the end is finished or repeated later."""
        self._thread.start()
        try:
            yield
        finally:
            self._closing.set()
            self._thread.join()


@contextmanager
def couriers(store: Store, settings: OutboxSettings) -> Iterator[None]:
    """One for each receiver of the station file.

    :raises InputRefused: a secret cannot be used, or two receivers cannot be told apart.
    """
    receivers: list[Receiver] = [
        *(Webhook(one) for one in settings.webhook),
        *(Folder(one) for one in settings.folder),
        *(Mqtt(one) for one in settings.mqtt),
    ]
    _refuse_twins(receiver.name for receiver in receivers)
    with ExitStack() as working:
        for receiver in receivers:
            store.enqueue(receiver.name, receiver.events)
            working.enter_context(Courier(store, receiver, settings).working())
        yield


def _refuse_twins(names: Iterable[str]) -> None:
    """Two of one name would take each other's events.  :raises InputRefused:"""
    for name, count in Counter(names).items():
        if count > 1:
            raise InputRefused(
                f"The station file has {count} receivers called {name}; give each its own address, topic or"
                " folder. The query of an address does not count."
            )
