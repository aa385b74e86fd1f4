"""The log: one line for each message, whatever names and answers from outside contain."""

from __future__ import annotations

import logging
from pathlib import Path

from station.cli.machine_options import logging_to


def test_a_message_forges_no_other_entry(tmp_path: Path) -> None:
    with logging_to(tmp_path, terminal=logging.CRITICAL):
        logging.getLogger("x").warning("Stop by %s", "eve\r\n2026-11-28 00:00:00,000 WARNING x: Stop by ada")
        try:
            raise ValueError("trouble")
        except ValueError:
            logging.getLogger("x").exception("It failed")
    forged, failed, *traceback = (tmp_path / "station.log").read_text().splitlines()
    assert forged.endswith(r"Stop by eve\r\n2026-11-28 00:00:00,000 WARNING x: Stop by ada")
    assert failed.endswith("ERROR x: It failed") and traceback[-1] == "ValueError: trouble"
