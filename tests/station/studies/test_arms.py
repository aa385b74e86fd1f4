"""Logs of random arms: what is counted, and that the loop gets through."""

from __future__ import annotations

from dataclasses import replace

import pytest

from station.studies.arms import Judged, figures
from station.studies.arms.one import judged

CLEAN = 1000047
RIPPLE = 1000050
CLAIM = Judged(
    "play", 100, "position", frozenset({2}), verdict="explained", named=frozenset({2}), confirmed=True,
    left_out_mm=(0.1, 0.05),
)  # fmt: skip


def test_nothing_is_claimed_of_a_clean_arm() -> None:
    found = judged(CLEAN)
    assert (found.kind, found.poses, found.joints) == ("clean", 40, frozenset())
    assert found.traceback == found.refused == ""
    assert not found.named
    assert not found.confirmed


def test_the_joint_with_a_ripple_is_found() -> None:
    found = judged(RIPPLE)
    assert found.kind == "ripple"
    assert found.named == found.joints == {5}
    assert not found.unsupported


@pytest.mark.parametrize(
    ("claim", "unsupported"),
    [
        (CLAIM, False),
        (replace(CLAIM, left_out_mm=(0.05, 0.05)), True),
        (replace(CLAIM, named=frozenset({2, 3})), True),
        (replace(CLAIM, named=frozenset({3}), confirmed=False), False),
    ],
)
def test_a_claim_needs_readings_that_were_left_out_and_the_right_joint(
    claim: Judged, *, unsupported: bool
) -> None:
    assert claim.unsupported == unsupported
    assert figures([claim])["confirmed_without_support"] == unsupported


def test_refusals_and_tracebacks_are_counted_and_kept_word_for_word() -> None:
    found = figures([CLAIM, replace(CLAIM, refused="No."), replace(CLAIM, traceback="ValueError")])
    assert found["refused"] == {"No.": 1}
    assert found["tracebacks"] == ["ValueError"]
