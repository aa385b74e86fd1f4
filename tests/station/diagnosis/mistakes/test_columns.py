"""Copies, labels and resolutions: what the columns show without a fit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from station.diagnosis.mistakes import Context
from station.diagnosis.mistakes.duplicates import pasted_block, readout_stuck, same_readings
from station.diagnosis.mistakes.gross import best_run, grown
from station.diagnosis.mistakes.labels import approach_columns, position_labels, time_column
from station.diagnosis.mistakes.mistake import Mistake, named
from station.five_bar.robot_file import Robot
from station.records import MistakeRecord, phrase
from station.studies.confusion.spoiling import measured

ROBOT = Robot.default()
FILES = measured(98).files
SEQUENCE, FRESH = FILES.sequence, FILES.fresh


def test_an_honest_file_has_none_of_these() -> None:
    context = Context.of(SEQUENCE)
    assert same_readings(SEQUENCE, FRESH) is None
    for file in (SEQUENCE, FRESH):
        assert pasted_block(ROBOT, file) is None and readout_stuck(ROBOT, file) is None
    assert position_labels(SEQUENCE, context) is None
    assert time_column(SEQUENCE) is None
    assert approach_columns(ROBOT, SEQUENCE) is None


def test_rows_of_a_paste_and_of_a_standing_readout() -> None:
    distance = SEQUENCE.distance.copy()
    distance[60:70] = distance[10:20]
    found = pasted_block(ROBOT, replace(SEQUENCE, distance=distance))
    assert found is not None and found.rows == SEQUENCE.ids[60:70]
    distance = SEQUENCE.distance.copy()
    distance[30:36] = distance[30]
    found = readout_stuck(ROBOT, replace(SEQUENCE, distance=distance))
    assert found is not None and found.rows == SEQUENCE.ids[30:36]


def test_time_that_runs_backwards_names_its_row() -> None:
    t_s = SEQUENCE.t_s.copy()
    t_s[40:] -= 20.0
    found = time_column(replace(SEQUENCE, t_s=t_s))
    assert found is not None and found.severity == "label" and found.rows == (SEQUENCE.ids[40],)


@pytest.mark.parametrize("by", [1, -1])
def test_approaches_a_row_off(by: int) -> None:
    found = approach_columns(ROBOT, replace(SEQUENCE, approach=np.roll(SEQUENCE.approach, by, axis=0)))
    assert found is None or found.kind == "approach_sign"


def test_one_wrong_label() -> None:
    position = SEQUENCE.position.copy()
    position[17] = position[40]
    found = position_labels(replace(SEQUENCE, position=position), Context.of(SEQUENCE))
    assert found is not None and SEQUENCE.ids[17] in found.rows


def test_best_run_and_its_neighbours() -> None:
    run = best_run(np.array([-1.0, 2.0, -0.5, 3.0, -4.0, 1.0]))
    assert run is not None and np.flatnonzero(run).tolist() == [1, 2, 3]
    assert best_run(np.array([-1.0, -2.0])) is None
    over = np.array([True, False, False, False, True, False])
    assert np.flatnonzero(grown(run, over)).tolist() == [0, 1, 2, 3, 4]


def test_ids_in_words() -> None:
    assert named((7,)).text() == "reading 7"
    assert named((3, 9, 12)).text() == "readings 3, 9 and 12"
    assert named(tuple(range(61, 121))).text() == "readings 61 to 120"
    assert named(tuple(range(0, 40, 2))).text() == "20 readings (0, 2, 4, 6, 8, 10, ... 38)"


def test_the_documents_object() -> None:
    said = phrase("time", what=phrase("time_backwards", rows=named((1,))))
    record = Mistake("time", said, (1, "a"), "label").record()
    assert (record.kind, record.rows, record.said) == ("time", (1, "a"), said)
    assert record.text.startswith("Column t_s: time runs backwards at reading 1; the diagnosis goes on")
    assert MistakeRecord.model_validate_json(record.model_dump_json()) == record
    older = MistakeRecord.model_validate_json('{"kind": "time", "text": "Text.", "rows": []}')
    assert older.said is None
