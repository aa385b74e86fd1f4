"""Faults on order: each comes when it was ordered, on its device, and is recovered from or named."""

from __future__ import annotations

import pytest
from pydantic import ValidationError

from drivers.driver import Drive
from drivers.emulated.orders import ORDERS, FaultOrder, Kind, Orders
from drivers.emulated.rig import EmulatedRig
from drivers.emulated.rig_file import dump_rig, parse_rig
from drivers.errors import DeviceError
from drivers.protocols import LinearScale, ServoAxis
from drivers.scales import SCALES
from drivers.scaling import JointScaling
from drivers.servos import SERVOS


class Clock:
    time_s = 0.0

    def __call__(self) -> float:
        return self.time_s


def test_after_for_and_count() -> None:
    clock = Clock()
    orders = Orders(
        [
            FaultOrder(device="axis1", kind="silent", after_s=1.0, for_s=2.0),
            FaultOrder(device="line", kind="late", count=2),
            FaultOrder(device="scale", kind="jump"),
        ],
        clock,
    )
    assert orders.due("silent", "axis1") is None
    assert [orders.due("late", "axis2", "line") is not None for _ in range(3)] == [True, True, False]
    assert [orders.due("jump", "scale") is not None for _ in range(2)] == [True, False]
    clock.time_s = 1.5
    assert orders.due("silent", "axis1") is not None
    assert orders.due("silent", "axis2") is None
    clock.time_s = 3.0
    assert orders.due("silent", "axis1") is None
    orders.replace([])
    assert orders.given == ()


@pytest.mark.parametrize(
    ("order", "complaint"),
    [
        ({"device": "scale", "kind": "alarm"}, "scale cannot have alarm; it can have silent"),
        ({"device": "axis3", "kind": "silent"}, "device"),
        ({"device": "axis1", "kind": "tired"}, "kind"),
        ({"device": "axis1", "kind": "silent", "for_s": -1}, "for_s"),
        ({"device": "axis1", "kind": "silent", "count": 0}, "count"),
        ({"device": "axis1", "kind": "silent", "joint": 1}, "joint"),
    ],
)
def test_what_cannot_be_ordered_is_refused(order: dict[str, object], complaint: str) -> None:
    with pytest.raises(ValidationError, match=complaint):
        ORDERS.validate_python([order])


def test_a_rig_file_may_order_faults() -> None:
    text = '[[fault]]\ndevice = "axis1"\nkind = "late"\nafter_s = 2.0\n[[fault]]\nkind = "scale_silent"\n'
    spec = parse_rig(text)
    assert spec.orders == (FaultOrder(device="axis1", kind="late", after_s=2.0),)
    assert [fault.kind for fault in spec.faults] == ["scale_silent"]
    assert parse_rig(dump_rig(spec)) == spec


def devices(rig: EmulatedRig) -> tuple[LinearScale, ServoAxis]:
    scale, servo = SCALES["heidenhain-nd"], SERVOS["leadshine-el7"]
    drive = Drive("servo axis 1", 1, JointScaling(10_000, 20, 0.0, 1))
    (axis,) = servo.make(servo.settings.model_validate({"url": rig.servo_url, "timeout_s": 0.5}), [drive])
    return scale.make(scale.settings.model_validate({"url": rig.scale_url, "timeout_s": 0.3})), axis


def order(rig: EmulatedRig, kind: Kind, device: str, count: int | None) -> None:
    rig.orders.replace([FaultOrder.model_validate({"device": device, "kind": kind, "count": count})])


WIRE: tuple[Kind, ...] = ("silent", "bad_crc", "short", "garbage", "twice", "port_gone")


@pytest.mark.parametrize("kind", [*WIRE, "wrong_id", "wrong_function", "exception", "half_open", "echo"])
def test_one_bad_reply_of_a_drive_is_overcome(rig: EmulatedRig, kind: Kind) -> None:
    scale, axis = devices(rig)
    axis.connect()
    order(rig, kind, "axis1", count=1)
    assert axis.feedback_deg() == 0.0
    assert axis.feedback_deg() == 0.0
    axis.close()
    scale.close()


@pytest.mark.parametrize("kind", WIRE)
def test_one_bad_reply_of_the_readout_is_overcome(rig: EmulatedRig, kind: Kind) -> None:
    scale, _ = devices(rig)
    scale.connect()
    before_mm = scale.read_mm()
    order(rig, kind, "scale", count=1)
    assert [scale.read_mm(), scale.read_mm()] == pytest.approx([before_mm] * 2, abs=0.02)
    scale.close()


@pytest.mark.parametrize(
    ("kind", "named"),
    [
        ("contaminated", "marks its value as faulty"),
        ("overspeed", "marks its value as faulty"),
        ("unit", "counts in inches"),
        ("echo", r"\(echo\)"),
    ],
)
def test_a_readout_that_is_not_well_is_named(rig: EmulatedRig, kind: Kind, named: str) -> None:
    scale, _ = devices(rig)
    scale.connect()
    order(rig, kind, "scale", count=None)
    with pytest.raises(DeviceError, match=named):
        scale.read_mm()
    rig.orders.replace([])
    scale.read_mm()
    scale.close()


def test_jump_and_frozen(rig: EmulatedRig) -> None:
    scale, _ = devices(rig)
    scale.connect()
    before_mm = scale.read_mm()
    rig.orders.replace([FaultOrder(device="scale", kind="jump", mm=0.5)])
    assert scale.read_mm() == pytest.approx(before_mm + 0.5, abs=0.02)
    assert scale.read_mm() == pytest.approx(before_mm + 0.5, abs=0.02)
    order(rig, "frozen", "scale", count=None)
    assert scale.read_mm() == scale.read_mm()
    scale.close()


def test_alarm_reboot_and_lost_counts(rig: EmulatedRig) -> None:
    _, axis = devices(rig)
    axis.connect()
    axis.enable()
    order(rig, "alarm", "axis1", count=None)
    assert axis.status().alarm is not None
    rig.orders.replace([])
    axis.reset_alarm()
    order(rig, "lost_counts", "axis1", count=None)
    assert axis.feedback_deg() == pytest.approx(-500 / (10_000 * 20 / 360))
    order(rig, "reboot", "axis1", count=None)
    assert not axis.status().enabled
    assert axis.feedback_deg() == 0.0
    rig.orders.replace([])
    assert axis.feedback_deg() == 0.0  # homed again, and it has not moved
    axis.close()


def test_a_stop_is_not_confirmed_by_an_echo(rig: EmulatedRig) -> None:
    _, axis = devices(rig)
    axis.connect()
    order(rig, "echo", "line", count=None)
    with pytest.raises(DeviceError, match="did not confirm its stop"):
        axis.quick_stop()
    rig.orders.replace([])
    axis.quick_stop()
    axis.close()


def test_a_half_open_link_does_not_lose_the_stop(rig: EmulatedRig) -> None:
    _, axis = devices(rig)
    axis.connect()
    axis.enable()
    axis.move_to(50.0, 10.0)
    order(rig, "half_open", "axis1", count=1)
    axis.quick_stop()
    assert not axis.status().in_position
    axis.close()
