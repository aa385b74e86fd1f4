"""The settings of the last start, and the differences found at a start."""

from __future__ import annotations

from collections.abc import Mapping

from station.records import Actor
from station.store.audit import AuditTrail

SECRET = "changed; its value is not shown"  # noqa: S105 - what stands in place of one


class SettingsInUse(AuditTrail):
    """Each difference is an entry in the audit."""

    def settings_in_use(self) -> dict[str, str]:
        """Settings of the last start by key; empty before the first."""
        return {row["key"]: row["value"] for row in self._readers.all("SELECT * FROM settings_in_use")}

    def use_settings(self, by: Actor, values: Mapping[str, str], secret: frozenset[str]) -> None:
        """Store the settings of this start; differences from the last one are recorded, one entry per key.

        :param values: by key, in text
        :param secret: keys whose values are stored as hashes and never shown
        """
        before = self.settings_in_use()
        if before == values:
            return
        with self._writing() as db:
            db.execute("DELETE FROM settings_in_use")
            for key, value in values.items():
                db.execute("INSERT INTO settings_in_use VALUES (?, ?)", [key, value])
            for key in sorted(before.keys() | values.keys()) if before else ():
                if before.get(key) != values.get(key):
                    told = [SECRET if key in secret and m else m for m in (before.get(key), values.get(key))]
                    old, new = ({"value": value} if value is not None else None for value in told)
                    self.record(by, "setting.changed", f"setting {key}", before=old, after=new)
