"""The appearance of views: compared with reference pictures, and free of unreadable texts.

Pictures are small (an eighth of the size, 16 greys), drawn with fonts that are stable in Debian and with two
zeros for every number and hash, so that another computer, another day and other noise give the same picture.
`make pictures` makes them again; check the changes before you commit them.
"""

from __future__ import annotations

import os
from io import BytesIO
from pathlib import Path
from tempfile import gettempdir

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from playwright.sync_api import Page

PICTURES = Path(__file__).parent / "pictures"
SPOILED = (Path(__file__).parent / "spoiled.js").read_text()
MAKE = "STATION_PICTURES"
"""Environment variable: reference pictures are written, not compared; a folder takes them in full size."""
CELL_PX, GREYS = 8, 16
SAME = 32
"""Of 255: a smaller difference between two cells is not visible at a distance."""
MOST_DIFFERENT = 0.003
"""Maximum share of all cells; about a word. Noise of the readings, in charts and maps, made 0.0002."""
STYLE = """
  *, *::before, *::after { font-family: "DejaVu Sans", "WenQuanYi Micro Hei" !important; }
  header time, .where small, .values dd { visibility: hidden !important; }
"""
STYLED = """css => {
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(css);
  document.adoptedStyleSheets = [sheet];
}"""
ZEROS = r"""() => {
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const zeros = node.data.replace(/\b[\da-f]*\d[\da-f]*\b|\d+/g, "00").replace(/[+−]/g, "");
    if (zeros !== node.data) node.data = zeros;
  }
}"""
WORDS = r"""besides => {
  const words = [];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const owner = node.parentElement;
    const names = owner.closest(`script, style, .serial, .language, .name, ${besides}`);
    const text = node.data.replace(/station [a-z-]+( --[a-z-]+)*/g, "");  // a command to be typed
    if (!names && owner.checkVisibility()) words.push(...(text.match(/[A-Za-z]{3,}/g) ?? []));
  }
  return [...new Set(words)];
}"""
SAME_EVERYWHERE = frozenset(
    {"ada", "csv", "fb", "html", "http", "json", "mes", "min", "new", "pdf", "pin", "utc"}
)
"""Names, units and file formats, which are the same in every language."""
Cells = NDArray[np.float64]


def spoiled(page: Page) -> list[str]:
    """Texts that overlap each other or a button, are cut off, or are outside the page."""
    found: list[str] = page.evaluate(SPOILED)
    return found


def foreign_words(page: Page, besides: str) -> list[str]:
    """Latin words of a page in Chinese, except names, units, formats and contents of elements `besides`."""
    words: list[str] = page.evaluate(WORDS, besides)
    return [word for word in words if word.lower() not in SAME_EVERYWHERE]


def picture(page: Page, shown: Path | None = None) -> Image.Image:
    """The whole view for the comparison; in full size, with its real digits, as file `shown`."""
    options = {"full_page": True, "animations": "disabled", "caret": "hide"}
    if shown is not None:
        page.screenshot(path=shown, **options)  # type: ignore[arg-type]
    page.evaluate(ZEROS)
    whole = Image.open(BytesIO(page.screenshot(**options))).convert("L")  # type: ignore[arg-type]
    small = whole.resize((whole.width // CELL_PX, whole.height // CELL_PX), Image.Resampling.BOX)
    step = 256 // GREYS
    return small.point(lambda grey: grey // step * (255 // (GREYS - 1)))


def share_that_differs(one: Image.Image, other: Image.Image) -> float:
    """Share of the cells, each with its neighbours; a cell that exists in only one of the two differs."""
    high, wide = max(one.height, other.height), max(one.width, other.width)
    a, b = (_blurred(_on_black(image, high, wide)) for image in (one, other))
    return float(np.mean(np.abs(a - b) > SAME))


def _on_black(image: Image.Image, high: int, wide: int) -> Cells:
    cells = np.zeros((high, wide))
    cells[: image.height, : image.width] = np.asarray(image, float)
    return cells


def _blurred(cells: Cells) -> Cells:
    """The mean over three by three."""
    padded = np.pad(cells, 1, mode="edge")
    rows, columns = cells.shape
    shifted = [padded[i : i + rows, k : k + columns] for i in range(3) for k in range(3)]
    mean: Cells = np.mean(shifted, axis=0)
    return mean


def trouble_with(page: Page, name: str) -> str | None:
    """The fault in the appearance of a view; None if it agrees with its reference picture."""
    page.evaluate(STYLED, STYLE)
    if texts := spoiled(page):
        return f"{name}: {'; '.join(texts)}"
    file = PICTURES / f"{name}.png"
    folder = os.environ.get(MAKE)
    whole = Path(folder, f"{name.replace('/', '-')}.png") if folder and Path(folder).is_dir() else None
    seen = picture(page, whole)
    if folder:
        file.parent.mkdir(parents=True, exist_ok=True)
        seen.save(file, optimize=True)
        return None
    if not file.is_file():
        return f"{name}: there is no reference picture; make pictures"
    with Image.open(file) as reference:
        differs = share_that_differs(seen, reference.convert("L"))
    if differs <= MOST_DIFFERENT:
        return None
    seen.save(shown := Path(gettempdir()) / f"{name.replace('/', '-')}.png")
    return f"{name}: {100 * differs:.1f} % of the picture differ from {file}; it is now as {shown}"
