"""`/emulator`: faults on order, for training, demonstration and tests.  Only with the emulated machine."""

from __future__ import annotations

from starlette.exceptions import HTTPException

from station.errors import NotApplicable
from station.motion import EffectTable, EmulatedRig, FaultOrder
from station.people import Permission
from web.guarded import Router, needs
from web.problems import documented
from web.routes.parts import TheRuntime

router = Router(prefix="/emulator", tags=["emulator"])


@router.get(
    "/faults",
    response_model=list[FaultOrder],
    responses=documented(404, 409),
    dependencies=[needs(Permission.READ)],
)
def read_faults(runtime: TheRuntime) -> list[FaultOrder]:
    """The active orders."""
    return list(_seen_rig(runtime).faults)


@router.put(
    "/faults",
    response_model=list[FaultOrder],
    responses=documented(404),
    dependencies=[needs(Permission.MAINTAIN)],
)
def order_faults(body: list[FaultOrder], runtime: TheRuntime) -> list[FaultOrder]:
    """Activate these faults and no others; an empty list withdraws all.

    Without `for_s` and `count` a fault is active until it is withdrawn, except for events (`jump`,
    `lost_counts`, `reboot`, `alarm`, `following_error`), which happen once.
    """
    return list(_rig(runtime).order(body))


@router.get(
    "/effects",
    response_model=list[EffectTable],
    responses=documented(404, 409),
    dependencies=[needs(Permission.READ)],
)
def read_effects(runtime: TheRuntime) -> list[EffectTable]:
    """Imperfections ordered while the machine runs; those of its rig file are not listed."""
    return list(_seen_rig(runtime).effects)


@router.put(
    "/effects",
    response_model=list[EffectTable],
    responses=documented(404),
    dependencies=[needs(Permission.MAINTAIN)],
)
def order_effects(body: list[EffectTable], runtime: TheRuntime) -> list[EffectTable]:
    """Activate these imperfections of the machine and no others, as `[[effect]]` of a rig file."""
    return list(_rig(runtime).order_effects(body))


def _seen_rig(runtime: TheRuntime) -> EmulatedRig:
    """:raises NotApplicable: the ordered effects are hidden by an exercise."""
    rig = _rig(runtime)
    if runtime.training is not None and runtime.training.hides:
        raise NotApplicable("An unseen exercise is under way; reveal it at the training desk first.")
    return rig


def _rig(runtime: TheRuntime) -> EmulatedRig:
    if runtime.rig is None:
        raise HTTPException(
            404, "This station has real devices; faults can be ordered of the emulated ones only."
        )
    return runtime.rig
