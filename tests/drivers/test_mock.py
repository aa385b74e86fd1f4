"""The in-process devices keep the promises of the real ones."""

from __future__ import annotations

import pytest

from drivers.errors import LinkLost
from drivers.mock import MockAxis, MockScale
from drivers.protocols import LinearScale, ServoAxis


def test_scale_reads_what_it_is_told_and_fails_when_told() -> None:
    scale = MockScale(lambda: 12.5)
    scale.fail("read_mm", LinkLost("no cable"))
    with pytest.raises(LinkLost, match="no cable"):
        scale.read_mm()
    assert scale.read_mm() == 12.5
    assert scale.calls == ["read_mm", "read_mm"]
    assert isinstance(scale, LinearScale)


def test_axis_moves_at_once_unless_held() -> None:
    axis = MockAxis(name="servo axis 1")
    axis.connect()
    axis.enable()
    axis.move_to(10.0, 5.0)
    assert axis.status().in_position and axis.feedback_deg() == 10.0
    axis.held = True
    axis.move_to(20.0, 5.0)
    assert axis.status().moving
    axis.quick_stop()
    assert not axis.status().moving and not axis.status().in_position
    axis.preset(0.0)
    assert axis.feedback_deg() == 0.0
    axis.make_safe()
    axis.close()
    assert not axis.connected
    assert isinstance(axis, ServoAxis)
