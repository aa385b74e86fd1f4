"""A backup test: make a backup, open it beside the history, and compare the two."""

from __future__ import annotations

import time
from contextlib import closing
from pathlib import Path

from station.errors import InputRefused, StoreUnavailable
from station.records import AuditChecked, BackupDrill, CountedTable
from station.service.backups import make_backup
from station.store import Store, Verified

_NOTHING = Verified(runs=0, older=0, head="", broken=None)
_NO_AUDIT = AuditChecked(entries=0, head="", broken=None)


def drill(store: Store, folder: Path, keep: int) -> BackupDrill:
    """One more backup, checked as `station restore` and `station verify` would; the history is not touched.

    Rows are added meanwhile, so each count of the backup lies between those before and after.

    :raises InputRefused: the backup cannot be written.
    """
    began_s = time.monotonic()
    before = store.counts()
    made = make_backup(store, folder, keep)
    after = store.counts()
    try:
        with closing(Store(Path(made.file), read_only=True)) as copy:
            counted, chain, audit = copy.counts(), copy.verify(), copy.check_audit()
    except (InputRefused, StoreUnavailable) as error:
        counted, chain, audit, trouble = {}, _NOTHING, _NO_AUDIT, str(error)
    else:
        trouble = _broken(store, chain, audit)
    tables = tuple(
        CountedTable(table=table, before=before[table], backup=counted.get(table, 0), after=after[table])
        for table in before
    )
    lost = [t.table for t in tables if not t.before <= t.backup <= t.after]
    if not trouble and lost:
        trouble = f"The backup has another number of rows in {', '.join(lost)} than the history."
    return BackupDrill(
        backup=made,
        passed=not trouble,
        trouble=trouble,
        tables=tables,
        chained_runs=chain.runs,
        head=chain.head,
        audit_entries=audit.entries,
        seconds=round(time.monotonic() - began_s, 3),
        restore=f"station restore {made.file}",
    )


def _broken(store: Store, chain: Verified, audit: AuditChecked) -> str:
    if chain.broken is not None:
        return f"Run {chain.broken.id} of the backup: {chain.broken.why}."
    if audit.broken is not None:
        return f"Entry {audit.broken} of the backup's audit is not as it was written."
    if chain.head and not store.in_chain(chain.head):
        return "The last run of the backup is not in the history."
    return ""
