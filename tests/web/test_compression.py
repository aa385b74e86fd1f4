"""What goes over the wire is compressed, and says so."""

from __future__ import annotations

import gzip

import pytest

from tests.web.conftest import Service

LONG = "/openapi.json"


def raw(service: Service, path: str, accepted: str) -> tuple[dict[str, str], bytes]:
    with service.client.stream("GET", path, headers={"Accept-Encoding": accepted}) as answer:
        return dict(answer.headers), b"".join(answer.iter_raw())


def test_a_long_answer_is_a_fifth_of_its_size_and_the_same(service: Service) -> None:
    headers, plain = raw(service, LONG, "identity")
    assert "content-encoding" not in headers
    headers, packed = raw(service, LONG, "br;q=1.0, gzip;q=0.8")
    assert headers["content-encoding"] == "gzip"
    assert "Accept-Encoding" in headers["vary"]
    assert len(packed) < len(plain) / 5
    assert gzip.decompress(packed) == plain


@pytest.mark.parametrize(
    ("path", "accepted"),
    [("/healthz", "gzip"), (LONG, "gzip;q=0"), (LONG, "br"), ("/api/v1/quality?x=1", "gzip")],
)
def test_what_is_short_or_not_wanted_so_is_sent_as_it_is(service: Service, path: str, accepted: str) -> None:
    assert "content-encoding" not in raw(service, path, accepted)[0]


def test_a_compressed_answer_is_known_by_its_tag(service: Service) -> None:
    path = f"/api/v1/calibrations/{service.complete()}"
    headers, _ = raw(service, path, "gzip")
    if headers.get("content-encoding") == "gzip":
        assert headers["etag"].startswith("W/")
    again = service.client.get(path, headers={"If-None-Match": headers["etag"], "Accept-Encoding": "gzip"})
    assert again.status_code == 304
