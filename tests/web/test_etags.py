"""`ETag`: what a client has already is not sent again, and what changed is."""

from __future__ import annotations

import pytest

from tests.web.conftest import Service

RUNS = "/api/v1/calibrations"


def strong(tag: str) -> str:
    return tag.removeprefix("W/")


@pytest.mark.parametrize("form", ["", "/readings", "/readings.csv"])
def test_what_the_client_has_is_not_sent_again(service: Service, form: str) -> None:
    path = f"{RUNS}/{service.complete()}{form}"
    first = service.client.get(path)
    tag = strong(first.headers["etag"])  # a packed answer has a weak one
    assert tag.startswith('"') and "no-store" not in first.headers["cache-control"]
    for known in (tag, f"W/{tag}", f'"other", {tag}', "*"):
        again = service.client.get(path, headers={"If-None-Match": known})
        assert (again.status_code, again.content, strong(again.headers["etag"])) == (304, b"", tag), known
        assert again.headers["x-content-type-options"] == "nosniff"
        assert "content-type" not in again.headers
    assert service.client.get(path, headers={"If-None-Match": '"other"'}).content == first.content
    assert service.client.head(path, headers={"If-None-Match": tag}).status_code == 304


def test_a_run_that_goes_on_has_another_tag_when_it_has_ended(service: Service) -> None:
    run = service.hold()
    tag = service.client.get(f"{RUNS}/{run}").headers["etag"]
    service.client.post(f"{RUNS}/{run}/abort")
    service.runtime.orchestrator.wait(run, 10)
    answer = service.client.get(f"{RUNS}/{run}", headers={"If-None-Match": tag})
    assert (answer.status_code, answer.json()["state"]) == (200, "aborted")


def test_an_error_has_no_tag(service: Service) -> None:
    answer = service.client.get(f"{RUNS}/9", headers={"If-None-Match": "*"})
    assert answer.status_code == 404 and "etag" not in answer.headers
