"""True and false are no numbers: in bodies, orders, station file, robot file and rig file."""

from __future__ import annotations

from typing import Any

import pytest
from pydantic import BaseModel, TypeAdapter, ValidationError

from drivers.emulated.imperfections import AnyEffect
from drivers.emulated.orders import FaultOrder
from drivers.emulated.spec import RigSpec
from station.errors import InputRefused
from station.five_bar import Robot
from station.settings import Settings
from web.bodies import AnswerBody, CalibrationBody, SolveBody, TranslateBody

RUN = {"robot_serial": "FB-1", "plan": "paper", "operator": "ada"}
ANGLE = {"kind": "joint_angle", "joint": 1, "at_deg": 0, "reads_deg": 0.01, "sd_deg": 0.005}
SERVO = {"profile": "leadshine-el7", "url": "modbus+tcp://10.0.0.7:502"}
SCALE = {"protocol": "heidenhain-nd", "url": "serial:///dev/ttyUSB0"}


@pytest.mark.parametrize(
    ("model", "content"),
    [
        (FaultOrder, {"device": "scale", "kind": "jump", "mm": False}),
        (FaultOrder, {"device": "scale", "kind": "jump", "count": True}),
        (RigSpec, {"machine": {"zero_offsets_deg": [1.0, True]}}),
        (RigSpec, {"emulated": {"speed": True}}),
        (Settings, {"limits": {"speed_deg_s": True}}),
        (Settings, {"service": {"port": True}}),
        (Settings, {"scale": {**SCALE, "timeout_s": True}, "servo": SERVO}),
        (Settings, {"scale": SCALE, "servo": {**SERVO, "joint": [{"unit": True, "zero_at_deg": 0}] * 2}}),
        (CalibrationBody, {**RUN, "accuracy_mm": True}),
        (CalibrationBody, {**RUN, "references": [{**ANGLE, "at_deg": False}]}),
        (CalibrationBody, {**RUN, "references": [{**ANGLE, "joint": True}]}),
        (AnswerBody, {"prompt": "p", "value": True}),
        (SolveBody, {"targets": [{"x_mm": True, "y_mm": -700}]}),
        (TranslateBody, {"positions": [{"position": "P1", "theta1_deg": True, "theta2_deg": 180}]}),
    ],
)
def test_a_truth_value_is_refused_in_words(model: type[BaseModel], content: dict[str, Any]) -> None:
    with pytest.raises(ValidationError) as refused:
        model.model_validate(content)
    assert "must be a number, not true or false" in {e["msg"] for e in refused.value.errors()}


def test_imperfections_refuse_them_and_take_numbers() -> None:
    effects: TypeAdapter[Any] = TypeAdapter(AnyEffect)
    with pytest.raises(ValidationError, match="must be a number"):
        effects.validate_python({"kind": "backlash", "joint": 1, "width_deg": True})
    assert effects.validate_python({"kind": "backlash", "joint": 1, "width_deg": 1}).width_deg == 1.0


def test_a_robot_file_refuses_them() -> None:
    with pytest.raises(InputRefused, match="true or false"):
        Robot.from_dict({"robot": {"serial": "R1"}, "mechanism": {"drm_sd_mm": True}}, source="robot R1")


def test_numbers_pass_as_before() -> None:
    assert FaultOrder.model_validate({"device": "scale", "kind": "jump", "mm": 1, "count": 2}).mm == 1.0
    assert Settings.model_validate({"limits": {"speed_deg_s": 20}}).limits.speed_deg_s == 20.0
    assert CalibrationBody.model_validate({**RUN, "accuracy_mm": 1}).accuracy_mm == 1.0
