"""Every link of every page leads somewhere, and every page is reached from the index."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import pytest

from tests.docs.pages import ROOT, markdown, without_code

LINK = re.compile(r"(?<!\\)\[[^\]]*\]\(([^)\s]+)\)")
HEADING = re.compile(r"^#+ +(.+?) *#*$", re.MULTILINE)
PATH = re.compile(r"`((?:docs|station|drivers|web|tests|deploy)/[\w./-]+)`")
MADE = ("web/static",)


def links(page: Path) -> list[str]:
    return LINK.findall(re.sub(r"`[^`\n]*`", "", without_code(page.read_text(encoding="utf-8"))))


@cache
def anchors(page: Path) -> set[str]:
    """As GitHub makes them from the headings."""
    found: dict[str, int] = {}
    for heading in HEADING.findall(without_code(page.read_text(encoding="utf-8"))):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").lower()
        anchor = re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")
        found[anchor] = found.get(anchor, -1) + 1
    return {f"{name}-{k}" if k else name for name, times in found.items() for k in range(times + 1)}


@pytest.mark.parametrize("page", markdown(), ids=lambda p: str(p.relative_to(ROOT)))
def test_links_lead_somewhere(page: Path) -> None:
    broken = []
    for link in links(page):
        if re.match(r"[a-z]+:", link):
            continue
        target, _, anchor = link.partition("#")
        file = (page.parent / target).resolve() if target else page
        if not file.exists() or (anchor and anchor not in anchors(file)):
            broken.append(link)
    assert not broken


@pytest.mark.parametrize("page", markdown(), ids=lambda p: str(p.relative_to(ROOT)))
def test_files_that_are_named_exist(page: Path) -> None:
    """In the text of a page; the blocks of a guide name files that it makes."""
    text = without_code(page.read_text(encoding="utf-8"))
    made = set(re.findall(r"^```+\w+ (\S+)$", page.read_text(encoding="utf-8"), re.MULTILINE))
    named = {name for name in PATH.findall(text) if not name.startswith(MADE)}
    if page.name == "CHANGELOG.md" or "decisions" in page.parts:
        return  # they speak of what was
    assert not {name for name in named - made if not (ROOT / name).exists()}


def test_the_index_leads_to_every_page() -> None:
    index = ROOT / "docs/README.md"
    reached = {(index.parent / link.partition("#")[0]).resolve() for link in links(index)}
    pages = {
        p
        for p in (ROOT / "docs").rglob("*.md")
        if p != index and p.parent.name not in ("decisions", "real-robot")
    }
    assert {str(p.relative_to(ROOT)) for p in pages - reached} == set()
