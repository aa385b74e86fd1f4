"""`python -m station.reference FOLDER` writes the pages of the reference into a folder."""

from __future__ import annotations

import sys
from pathlib import Path

from station.reference import pages

if __name__ == "__main__":
    folder = Path(sys.argv[1])
    for name, text in pages().items():
        (folder / name).write_text(text, encoding="utf-8")
