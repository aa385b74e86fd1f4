"""`/audit`: the actions and their authors."""

from __future__ import annotations

import json
from typing import Annotated

from fastapi import Query
from pydantic import Field

from station.people import Permission
from station.records import AuditEntry, Record, csv_text
from web.guarded import Router, needs
from web.routes.parts import CsvResponse, Cursor, TheRuntime, page_of

router = Router(tags=["audit"])

Contained = Annotated[
    str, Query(max_length=64, description="text in name, role, action, subject or values, in any case")
]
_COLUMNS = ("n", "at", "who", "via", "role", "action", "subject", "before", "after", "hash")
_ALL = 1_000_000


class AuditList(Record):
    """The newest entries first."""

    items: list[AuditEntry]
    next: int | None = Field(description="cursor of the next page, null on the last")


@router.get("/audit", response_model=AuditList, dependencies=[needs(Permission.ADMINISTER)])
def read_audit(
    runtime: TheRuntime,
    limit: Annotated[int, Query(ge=1, le=500)] = 100,
    cursor: Cursor = None,
    contains: Contained = "",
) -> AuditList:
    """Every start, stop, application, change and sign-in. `station audit` checks the chain too."""
    found = runtime.store.audit(limit=limit + 1, cursor=cursor, contains=contains.strip())
    items, last = page_of(found, limit)
    return AuditList(items=items, next=last.n if last else None)


@router.get("/audit.csv", response_class=CsvResponse, dependencies=[needs(Permission.ADMINISTER)])
def download_audit(runtime: TheRuntime, contains: Contained = "") -> CsvResponse:
    """The whole audit, newest entry first."""
    found = runtime.store.audit(limit=_ALL, contains=contains.strip())
    entries = (entry.model_dump(mode="json") for entry in found)
    rows = ([_cell(entry[column]) for column in _COLUMNS] for entry in entries)
    return CsvResponse(
        csv_text(_COLUMNS, rows), headers={"Content-Disposition": 'attachment; filename="audit.csv"'}
    )


def _cell(value: object) -> object:
    return json.dumps(value, ensure_ascii=False) if isinstance(value, dict | list) else value
