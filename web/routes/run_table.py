"""`/calibrations.csv`: the list of runs as a table, sent while it is read."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict

from fastapi.responses import StreamingResponse

from station.people import Permission
from station.records import CalibrationSummary, csv_text
from station.store import Filters, Order, Store
from web.guarded import Router, needs
from web.routes.calibrations import TheFilters, TheOrder
from web.routes.parts import CsvResponse, TheRuntime

router = Router(tags=["calibrations"])

PAGE = 500
SAME = (
    "id", "uid", "created_at", "started_at", "ended_at", "robot_serial", "work_order", "kind", "plan",
    "operator", "state", "verdict", "outcome", "reason_code", "reason",
)  # fmt: skip
OFFSETS = ("dtheta1_deg", "dtheta1_sd_deg", "dtheta2_deg", "dtheta2_sd_deg")


@router.get("/calibrations.csv", response_class=CsvResponse, dependencies=[needs(Permission.READ)])
def download_runs(runtime: TheRuntime, filters: TheFilters, order: TheOrder = "newest") -> StreamingResponse:
    """Every run of the list with the same filters; standard uncertainties are in the columns `_sd_`."""
    return StreamingResponse(
        _pieces(runtime.store, filters, order),
        media_type="text/csv",
        headers={"Content-Disposition": 'attachment; filename="runs.csv"'},
    )


def _pieces(store: Store, filters: Filters, order: Order) -> Iterator[str]:
    cursor: int | None = None
    first = True
    while True:
        page = store.calibrations(limit=PAGE, cursor=cursor, order=order, **asdict(filters))
        text = csv_text((*SAME, *OFFSETS), map(_row, page.items))
        yield text if first else text.partition("\n")[2]
        first, cursor = False, page.next
        if cursor is None:
            return


def _row(run: CalibrationSummary) -> list[object]:
    flat = run.model_dump(mode="json")
    zeros = {zero.joint: zero for zero in run.zero_offsets}
    offsets = [getattr(zeros.get(joint), name, None) for joint in (1, 2) for name in ("value_deg", "sd_deg")]
    return [*(flat[column] for column in SAME), *offsets]
