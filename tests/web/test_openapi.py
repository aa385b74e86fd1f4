"""The checked-in interface description and what is made from it."""

from __future__ import annotations

import json
from typing import Any

from tests.web.conftest import Service
from web import openapi
from web.application import FILE


def operations(document: dict[str, Any]) -> list[tuple[str, dict[str, Any]]]:
    return [
        (f"{method} {path}", operation)
        for path, item in document["paths"].items()
        for method, operation in item.items()
    ]


def test_the_file_is_up_to_date() -> None:
    assert FILE.read_text(encoding="utf-8") == openapi.text(), "run `python -m web.openapi`"


def test_it_is_what_the_service_serves(service: Service) -> None:
    assert service.client.get("/openapi.json").json() == json.loads(FILE.read_text(encoding="utf-8"))


def test_every_answer_has_a_schema() -> None:
    for name, operation in operations(json.loads(openapi.text())):
        for status, answer in operation["responses"].items():
            if status in ("204", "303"):  # without a body
                continue
            kinds = answer["content"]
            assert kinds, f"{name} {status}"
            told = status < "300" or (name, status) == ("post /api/v1/stop", "502")
            wanted = "application/json" if told else "application/problem+json"
            if wanted in kinds:
                assert kinds[wanted]["schema"], f"{name} {status}"
            else:
                told_as = (["text/csv"], ["text/html"], ["text/plain"], ["application/pdf"])
                assert list(kinds) in told_as, f"{name} {status}"


def test_whatever_takes_a_body_may_find_it_too_slow_or_too_large() -> None:
    for name, operation in operations(json.loads(openapi.text())):
        assert ("requestBody" in operation) == ({"408", "413"} <= operation["responses"].keys()), name
