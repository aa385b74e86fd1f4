"""`station user`, `key` and `audit`, and where the service refuses to start."""

from __future__ import annotations

import csv
import io
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from station.cli import main
from station.errors import InputRefused
from station.people import secret_hash
from station.people.passwords import matches
from station.service import check_entrance, listens_on_loopback
from station.store.store import Store


def station(home: Path, *arguments: str, input: str | None = None) -> Result:
    return CliRunner().invoke(main, ["--home", str(home), *arguments], input=input)


def test_a_key_stands_alone_on_standard_output_and_nowhere_else(tmp_path: Path) -> None:
    made = station(tmp_path, "key", "add", "line 4", "--role", "mes", "--days", "30")
    assert made.exit_code == 0
    key = made.stdout.strip()
    assert made.stdout == f"{key}\n" and len(key) > 40
    assert key.encode() not in (tmp_path / "station.db").read_bytes()
    with closing(Store(tmp_path / "station.db", read_only=True)) as store:
        kept = store.key(secret_hash(key))
    assert kept is not None and (kept.name, kept.role) == ("line 4", "mes") and kept.expires_at is not None
    listed = station(tmp_path, "key", "list")
    assert "line 4" in listed.stdout and key not in listed.stdout
    twice = station(tmp_path, "key", "add", "line 4", "--role", "mes")
    assert twice.exit_code == 2 and "already" in twice.stderr
    assert station(tmp_path, "key", "revoke", "line 4").exit_code == 0
    assert station(tmp_path, "key", "revoke", "nothing").exit_code == 2
    assert station(tmp_path, "key", "add", "line 4", "--role", "king").exit_code == 2


def test_users_and_what_the_audit_says_of_them(tmp_path: Path) -> None:
    added = station(
        tmp_path, "user", "add", "Ada", "--role", "operator", "--password-stdin", input="correct horse\n"
    )
    assert added.exit_code == 0, added.output
    short = station(tmp_path, "user", "add", "Bo", "--role", "viewer", "--password-stdin", input="short\n")
    assert short.exit_code == 2 and "8 to 256" in short.stderr
    odd = station(tmp_path, "user", "add", "A\x00b", "--role", "viewer", "--password-stdin", input="x" * 9)
    assert odd.exit_code == 2
    assert "Ada" in station(tmp_path, "user", "list", "--home", str(tmp_path)).stdout
    assert station(tmp_path, "user", "remove", "ada", "--erase").exit_code == 0
    assert station(tmp_path, "user", "remove", "ada").exit_code == 2
    audit = station(tmp_path, "audit", "--csv")
    rows = list(csv.DictReader(io.StringIO(audit.stdout)))
    assert [(row["action"], row["via"]) for row in rows] == [
        ("user.removed", "terminal"), ("user.added", "terminal"),
    ]  # fmt: skip
    assert "Ada" not in audit.stdout


def test_a_badge_is_given_to_somebody_who_is_there_and_taken_away(tmp_path: Path) -> None:
    def bo(command: str, *options: str, input: str | None = None) -> Result:
        return station(tmp_path, "user", command, "Bo", *options, input=input)

    assert bo("badge", "--badge", "0042", "--pin-stdin", input="1234\n").exit_code == 2, "no history yet"
    bo("add", "--role", "operator", "--password-stdin", input="correct horse\n")
    alone = bo("badge", "--pin-stdin", input="1234\n")
    assert alone.exit_code == 2 and "no badge yet" in alone.stderr
    given = bo("badge", "--badge", "0042", input="1234\n1234\n")
    assert given.exit_code == 0 and "with the badge and the new PIN" in given.stderr
    assert bo("badge", "--pin-stdin", input="5678\n").exit_code == 0
    with closing(Store(tmp_path / "station.db", read_only=True)) as store:
        kept = store.badge_credentials(secret_hash("0042"))
    assert kept is not None and matches("5678", kept.secret_hash) and not matches("1234", kept.secret_hash)
    assert bo("badge", "--remove", "--pin-stdin", input="1\n").exit_code == 2
    assert bo("badge", "--remove").exit_code == 0
    with closing(Store(tmp_path / "station.db", read_only=True)) as store:
        assert store.badge_credentials(secret_hash("0042")) is None
    audit = station(tmp_path, "audit", "--csv").stdout
    assert [row["action"] for row in csv.DictReader(io.StringIO(audit))][::-1] == [
        "user.added", "user.badge_changed", "user.pin_changed", "user.pin_changed", "user.badge_removed",
    ]  # fmt: skip
    assert "0042" not in audit and "5678" not in audit


def test_an_audit_that_was_changed_is_named(tmp_path: Path) -> None:
    station(tmp_path, "key", "add", "line 4", "--role", "mes")
    assert station(tmp_path, "audit").exit_code == 0
    with closing(sqlite3.connect(tmp_path / "station.db")) as other, other:
        other.execute("UPDATE audit SET who = 'eve'")
    changed = station(tmp_path, "audit")
    assert changed.exit_code == 1 and "Entry 1 of the audit" in changed.stderr


@pytest.mark.parametrize(
    ("host", "emulated", "starts"),
    [
        ("127.0.0.1", True, True),
        ("localhost", True, True),
        ("::1", True, True),
        ("0.0.0.0", True, False),
        ("192.0.2.4", True, False),
        ("127.0.0.1", False, False),
    ],
)
def test_nobody_moves_a_real_machine_or_comes_from_elsewhere_without_a_key(
    tmp_path: Path, host: str, emulated: bool, starts: bool
) -> None:
    database = tmp_path / "station.db"
    for _ in ("without a history", "with one"):
        if starts:
            check_entrance(database, host, emulated=emulated)
        else:
            with pytest.raises(InputRefused, match="station user add"):
                check_entrance(database, host, emulated=emulated)
        Store(database).close()
    station(tmp_path, "key", "add", "line 4", "--role", "mes")
    check_entrance(database, host, emulated=emulated)


def test_what_loopback_is() -> None:
    assert listens_on_loopback("127.8.8.8") and listens_on_loopback("[::1]")
    assert not listens_on_loopback("127.0.0.1.example") and not listens_on_loopback("::")


def test_serve_beyond_loopback_without_a_key_is_refused(tmp_path: Path) -> None:
    refused = station(tmp_path, "serve", "--host", "0.0.0.0", "--port", "0")
    assert refused.exit_code == 2 and "nobody can sign in yet" in refused.stderr
    assert len(refused.stderr.splitlines()) == 1
