"""The audit is append-only, and every change of it is found; a name can be erased all the same."""

from __future__ import annotations

import sqlite3
from contextlib import closing

import pytest

from station.records import Actor
from station.store.store import Store

ADA = Actor(name="Ada", via="user", role="operator")


@pytest.fixture
def three(store: Store) -> Store:
    for n in (1, 2, 3):
        store.record(ADA, "run.started", f"run {n}", after={"plan": "rapid"})
    return store


@pytest.mark.parametrize(
    "sql",
    [
        "DELETE FROM audit WHERE n = 2",
        "UPDATE audit SET action = 'nothing' WHERE n = 2",
        "UPDATE audit SET at_ms = 0 WHERE n = 3",
    ],
)
def test_the_database_refuses_and_a_forced_change_is_found(three: Store, sql: str) -> None:
    with closing(sqlite3.connect(three.path)) as other:
        with pytest.raises(sqlite3.IntegrityError, match="append-only"):
            other.execute(sql)
        for trigger in ("audit_delete", "audit_update"):
            other.execute(f"DROP TRIGGER {trigger}")
        other.execute(sql)
        other.commit()
    assert three.check_audit().broken in (2, 3)


def test_a_name_is_erased_however_it_is_typed(store: Store) -> None:
    store.record(Actor(name="\u00d6d\u00f6n", via="user"), "run.started", "run 1")
    assert store.erase_name("O\u0308DO\u0308N") == 1
    assert store.audit()[0].who is None and store.check_audit().broken is None


def test_another_name_in_an_entry_is_found(three: Store) -> None:
    with closing(sqlite3.connect(three.path)) as other, other:
        other.execute("UPDATE audit SET who = 'Eve' WHERE n = 1")
    assert three.check_audit().broken == 1


def test_a_name_is_erased_without_breaking_the_chain(three: Store) -> None:
    before = three.check_audit()
    assert (before.entries, before.broken) == (3, None)
    assert three.erase_name("ada") == 3
    after = three.check_audit()
    assert after == before
    assert {entry.who for entry in three.audit()} == {None}
    with closing(sqlite3.connect(three.path)) as other:
        assert other.execute("SELECT count(*) FROM audit WHERE salt IS NOT NULL").fetchone() == (0,)
