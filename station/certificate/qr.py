"""The robot's serial as a QR code: a scanner at the station reads it as the serial of the next run."""

from __future__ import annotations

from collections.abc import Iterator

from reportlab.graphics.barcode import qrencoder

QUIET = 4
"""White margin around it, in modules (ISO/IEC 18004)."""


def modules(text: str) -> tuple[int, list[tuple[int, int]]]:
    """Modules along a side with the quiet zone, and the dark ones as (column, row) from the top left."""
    code = qrencoder.QRCode(None, qrencoder.QRErrorCorrectLevel.M)
    code.addData(text)
    code.make()
    return code.getModuleCount() + 2 * QUIET, list(_dark(code))  # type: ignore[no-untyped-call]


def _dark(code: qrencoder.QRCode) -> Iterator[tuple[int, int]]:
    count = code.getModuleCount()  # type: ignore[no-untyped-call]
    for row in range(count):
        for column in range(count):
            if code.isDark(row, column):  # type: ignore[no-untyped-call]
                yield column + QUIET, row + QUIET
