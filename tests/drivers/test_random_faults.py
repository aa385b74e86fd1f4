"""A few readings of `python -m tests.drivers.random_faults`, with more faults than there."""

from __future__ import annotations

import pytest

from tests.drivers.random_faults import measured


@pytest.mark.parametrize(
    ("servo", "scale", "line"), [("leadshine-el7", "siko", "tcp"), ("orientalmotor", "heidenhain-nd", "tcp")]
)
def test_no_wrong_value_is_stored(servo: str, scale: str, line: str) -> None:
    outcome = measured(servo, scale, line, readings=10, rate=0.03, seed=1)
    assert outcome.readings >= 10
    assert outcome.struck.total() > 0
    assert not outcome.wrong, outcome.text
