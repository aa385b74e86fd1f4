"""Tables as CSV that a spreadsheet displays and never computes."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence

from station.records.csv_cells import harmless


def csv_text(header: Sequence[str], rows: Iterable[Iterable[object]]) -> str:
    """The table with a header row."""
    text = io.StringIO()
    writer = csv.writer(text)
    writer.writerow(header)
    writer.writerows([harmless(cell) if isinstance(cell, str) else cell for cell in row] for row in rows)
    return text.getvalue()
