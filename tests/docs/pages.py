"""Pages of the documentation and the fenced blocks in them that a test executes."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
FENCE = re.compile(r"^(?P<fence>```+)(?P<info>[^\n`]*)\n(?P<body>.*?)^(?P=fence)$", re.MULTILINE | re.DOTALL)
WRITTEN = ("python", "toml", "json", "csv")


@dataclass(frozen=True)
class Block:
    """One fenced block: `console`, a file to write (`python NAME`), or a change to one (`diff NAME`)."""

    kind: str
    name: str
    body: str
    line: int


def markdown() -> list[Path]:
    """Every page of the repository."""
    folders = [ROOT, *(ROOT / name for name in ("docs", "web", "station", "drivers", "tests", "deploy"))]
    pages = [*ROOT.glob("*.md"), *(p for folder in folders[1:] for p in folder.rglob("*.md"))]
    return sorted(p for p in pages if "node_modules" not in p.parts)


def with_code() -> list[Path]:
    """The tutorials and guides whose blocks are executed."""
    pages = [*(ROOT / "docs/tutorials").glob("*.md"), *(ROOT / "docs/how-to").glob("*.md")]
    return sorted(page for page in pages if any(True for _ in blocks(page)))


def blocks(page: Path) -> Iterator[Block]:
    """The blocks in the order of the page."""
    text = page.read_text(encoding="utf-8")
    for match in FENCE.finditer(text):
        kind, _, name = match["info"].strip().partition(" ")
        if kind == "console" or (name and kind in (*WRITTEN, "diff")):
            yield Block(kind, name.strip(), match["body"], text[: match.start()].count("\n") + 1)


def without_code(text: str) -> str:
    """A page's text without its fenced blocks."""
    return FENCE.sub("", text)
