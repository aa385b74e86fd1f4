"""`/scans`: the codes that a scanner at the page may read, and refused scans."""

from __future__ import annotations

import re
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, StringConstraints

from station.people import Permission
from station.records import Actor, Record
from web.guarded import Router, needs
from web.routes.parts import TheRuntime

router = Router(prefix="/scans", tags=["scans"])

Because = Literal["unknown", "unreadable", "nothing_to_confirm"]


class ScanCodes(Record):
    """`[scan]` of the station file. Patterns match the whole text, ASCII only."""

    serial: str
    badge: str
    confirm: str


class RefusedScan(BaseModel):
    """The scanned text, as far as it may be stored, and why it was refused."""

    model_config = ConfigDict(extra="forbid")

    text: Annotated[str, StringConstraints(max_length=64, pattern=r"^[^\x00-\x1f\x7f]*$")]
    because: Because


@router.get("", response_model=ScanCodes, dependencies=[needs(Permission.ENTER)])
def read_codes(runtime: TheRuntime) -> ScanCodes:
    """Patterns by which the page recognizes a serial number, a badge and the code that confirms."""
    return ScanCodes(**runtime.settings.scan.model_dump())


@router.post("/refused", status_code=204)
def refuse(scan: RefusedScan, by: Annotated[Actor, needs(Permission.OPERATE)], runtime: TheRuntime) -> None:
    """Record in the audit that a scan was refused. A badge opens a session: its text is not stored."""
    badge = re.fullmatch(runtime.settings.scan.badge, scan.text, re.ASCII)
    runtime.store.record(
        by, "scan.refused", "a badge" if badge else scan.text, after={"because": scan.because}
    )
