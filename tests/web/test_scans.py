"""What a scanner at the page may read, and the audit of what was refused."""

from __future__ import annotations

from typing import Any

import pytest

from tests.web.conftest import Service

REFUSED = "/api/v1/scans/refused"


def test_the_codes_of_the_station_file_need_no_sign_in(closed: Service) -> None:
    assert closed.client.get("/api/v1/scans").json() == closed.runtime.settings.scan.model_dump()


def test_a_refused_scan_is_in_the_audit_but_a_badge_is_not(service: Service) -> None:
    for text in ("FB 7", "", "BADGE:0042"):
        answer = service.client.post(REFUSED, json={"text": text, "because": "unknown"})
        assert answer.status_code == 204
    kept = [(e.action, e.subject, e.after) for e in service.runtime.store.audit(limit=3)]
    assert kept == [("scan.refused", subject, {"because": "unknown"}) for subject in ("a badge", "", "FB 7")]


@pytest.mark.parametrize(
    "body",
    [
        {"text": "x" * 65, "because": "unknown"},
        {"text": "a\nb", "because": "unknown"},
        {"text": "a", "because": "whatever"},
        {"text": "a"},
    ],
)
def test_what_no_page_sends_is_refused(service: Service, body: dict[str, Any]) -> None:
    assert service.client.post(REFUSED, json=body).status_code == 422


def test_a_viewer_writes_nothing_into_the_audit(closed: Service) -> None:
    body = {"text": "a", "because": "unknown"}
    assert closed.client.post(REFUSED, json=body, headers=closed.key("viewer")).status_code == 403
