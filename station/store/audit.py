"""The audit: each action with its author, hashed together with the hash of the previous entry.

A person's name can be erased without breaking the chain: the entry contains the hash of the name and a salt,
and name and salt are erased together. The database refuses every other change of an entry.
"""

from __future__ import annotations

import json
import secrets
import sqlite3
from collections.abc import Mapping
from datetime import UTC, datetime

from pydantic import JsonValue

from station.records import Actor, AuditChecked, AuditEntry, account_key
from station.store.chain import link_hash, sha256
from station.store.kept_file import KeptFile
from station.store.rows import compact, millis
from station.store.times import now_ms

_HASHED = ("n", "at_ms", "who_sha256", "via", "role", "action", "subject", "before", "after")

_TEXT = (
    "coalesce(who, '') || ' ' || coalesce(role, '') || ' ' || via || ' ' || action || ' ' || subject"
    " || ' ' || replace(replace(coalesce(before, '') || ' ' || coalesce(after, ''), '\"', ''), ':', ' ')"
)
"""Searchable text of an entry: `{value 20}` for `{"value":"20"}`."""


class AuditTrail(KeptFile):
    """Append-only."""

    def record(
        self,
        by: Actor,
        action: str,
        subject: str,
        *,
        before: Mapping[str, JsonValue] | None = None,
        after: Mapping[str, JsonValue] | None = None,
        at: datetime | None = None,
    ) -> None:
        """Add an entry; within a transaction it is part of that.

        :param at: time of the action, if not now
        """
        with self._writing() as db:
            last = db.execute("SELECT n, hash FROM audit ORDER BY n DESC LIMIT 1").fetchone() or (0, "")
            salt = secrets.token_hex(16)
            row = {
                "n": last[0] + 1,
                "at_ms": now_ms() if at is None else millis(at),
                "who_sha256": sha256(f"{salt} {by.name}".encode()),
                "via": by.via,
                "role": by.role,
                "action": action,
                "subject": subject,
                "before": compact(dict(before)) if before else None,
                "after": compact(dict(after)) if after else None,
            }
            db.execute(
                f"INSERT INTO audit ({', '.join(_HASHED)}, who, salt, hash)"
                f" VALUES ({', '.join('?' * len(_HASHED))}, ?, ?, ?)",
                [*row.values(), by.name, salt, link_hash(last[1], row)],
            )

    def audit(self, *, limit: int = 100, cursor: int | None = None, contains: str = "") -> list[AuditEntry]:
        """Entries, newest first; only those before number `cursor`.

        :param contains: only entries that contain this in name, role, action, subject or values,
        case-insensitive
        """
        rows = self._readers.all(
            "SELECT * FROM audit WHERE n < coalesce(?, n + 1)"
            f" AND (? = '' OR instr(lower({_TEXT}), lower(?))) ORDER BY n DESC LIMIT ?",
            [cursor, contains, contains, limit],
        )
        return [_entry(row) for row in rows]

    def check_audit(self) -> AuditChecked:
        """Recompute every hash and compare."""
        head, count = "", 0
        for row in self._readers.all("SELECT * FROM audit ORDER BY n"):
            named = row["who"] is not None
            same_name = not named or sha256(f"{row['salt']} {row['who']}".encode()) == row["who_sha256"]
            whole = row["n"] == count + 1 and link_hash(head, {c: row[c] for c in _HASHED}) == row["hash"]
            if not (whole and same_name):
                return AuditChecked(entries=count, head=head, broken=row["n"])
            head, count = row["hash"], count + 1
        return AuditChecked(entries=count, head=head, broken=None)

    def erase_name(self, name: str) -> int:
        """Erase a person's name in the audit permanently; returns the number of entries."""
        with self._writing() as db:
            names = db.execute("SELECT DISTINCT who FROM audit WHERE who IS NOT NULL").fetchall()
            return sum(
                db.execute(
                    "UPDATE audit SET who = NULL, salt = NULL WHERE who = ? AND via IN ('user', 'terminal')",
                    [who],
                ).rowcount
                for (who,) in names
                if account_key(who) == account_key(name)
            )


def _entry(row: sqlite3.Row) -> AuditEntry:
    return AuditEntry(
        n=row["n"],
        at=datetime.fromtimestamp(row["at_ms"] / 1000, UTC),
        who=row["who"],
        via=row["via"],
        role=row["role"],
        action=row["action"],
        subject=row["subject"],
        before=json.loads(row["before"]) if row["before"] else None,
        after=json.loads(row["after"]) if row["after"] else None,
        hash=row["hash"],
    )
