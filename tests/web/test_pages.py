"""The served page: cached by content, confined to this host, the same without the internet."""

from __future__ import annotations

import os
import re
from pathlib import Path

import pytest

from tests.web.conftest import Service
from web import pages

STATIC = pages.STATIC
NAMESPACES = ("http://www.w3.org/",)
"""Names of XML vocabularies: no browser fetches them."""


@pytest.fixture
def built() -> Path:
    if not (STATIC / "index.html").is_file():
        if os.environ.get("CI") == "true":
            pytest.fail("the page is not built: run `npm run build` in web/ui")
        pytest.skip("the page is not built")
    return STATIC


def foreign_hosts(text: str) -> set[str]:
    return {
        url for url in re.findall(r"(?:https?|wss?)://[^\s\"'`<>)]+", text) if not url.startswith(NAMESPACES)
    }


@pytest.mark.parametrize("path", ["/", "/result", "/result/12", "/history"])
def test_every_view_is_the_same_html_and_asked_for_anew(service: Service, built: Path, path: str) -> None:
    answer = service.client.get(path)
    assert answer.text == (built / "index.html").read_text()
    assert answer.headers["cache-control"] == "no-cache"
    assert answer.headers["content-security-policy"].startswith("default-src 'self'")
    assert answer.headers["x-content-type-options"] == "nosniff"


def test_assets_carry_their_hash_and_are_kept(service: Service, built: Path) -> None:
    html = service.client.get("/").text
    assets = re.findall(r"(?:src|href)=\"([^\"]+)\"", html)
    assert assets
    for asset in assets:
        assert re.fullmatch(r"/assets/[\w-]+-[\w-]{8}\.\w+", asset)
        assert "immutable" in service.client.get(asset).headers["cache-control"]


def test_no_built_file_names_a_foreign_host(service: Service, built: Path) -> None:
    files = [file for file in built.rglob("*") if file.is_file()]
    assert files
    for file in files:
        served = service.client.get("/" + file.relative_to(built).as_posix().removesuffix("index.html"))
        assert served.status_code == 200
        assert foreign_hosts(served.text) == set(), file.name


def test_the_api_documentation_works_offline(service: Service) -> None:
    answer = service.client.get("/docs")
    assert foreign_hosts(answer.text) == set()
    for asset in re.findall(r"(?:src|href)=\"([^\"]+)\"", answer.text):
        assert asset.startswith("/docs-files/")
        assert service.client.get(asset).status_code == 200
    script_policy = re.search(r"script-src ([^;]+);", answer.headers["content-security-policy"])
    assert script_policy and script_policy[1].startswith("'self' 'sha256-")
    assert "unsafe-inline" not in script_policy[1]


def test_the_api_is_never_cached(service: Service) -> None:
    assert service.client.get("/api/v1/station").headers["cache-control"] == "no-store"


def test_a_page_that_is_not_built_says_what_to_do(tmp_path: Path, service: Service) -> None:
    assert pages.build_id(tmp_path) == "none"


def test_the_build_id_follows_the_page(tmp_path: Path) -> None:
    (tmp_path / "index.html").write_text("one")
    first = pages.build_id(tmp_path)
    (tmp_path / "index.html").write_text("two")
    assert pages.build_id(tmp_path) != first
