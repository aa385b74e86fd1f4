"""`/emulator/training`: the training desk.  Only with the emulated machine."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field
from starlette.exceptions import HTTPException

from station.people import Permission
from station.records import Actor, ChallengeGroup, TrainingView
from station.service import TrainingDesk
from web.bodies import Body
from web.guarded import Router, needs
from web.problems import documented
from web.routes.parts import TheRuntime

router = Router(prefix="/emulator/training", tags=["emulator"])

Trainer = Annotated[Actor, needs(Permission.MAINTAIN)]


ALL: tuple[ChallengeGroup, ...] = ("catalogue", "unnamed", "fault")


class ChallengeBody(Body):
    """The error to give the machine."""

    kind: Annotated[str, Field(max_length=64)]
    joint: Literal[1, 2] | None = Field(default=None, description="where the kind is at a joint")
    size: Annotated[float, Field(allow_inf_nan=False)] | None = Field(
        default=None, description="in the unit of the kind; null: a usual one"
    )


class DrawBody(Body):
    """Groups from which a hidden error is drawn."""

    groups: Annotated[tuple[ChallengeGroup, ...], Field(min_length=1, max_length=3)] = ALL


@router.get("", response_model=TrainingView, responses=documented(404), dependencies=[needs(Permission.READ)])
def read_training(runtime: TheRuntime) -> TrainingView:
    """The possible errors, the current exercise and the completed ones; a hidden error is not shown."""
    return _desk(runtime).view()


@router.post("", status_code=201, response_model=TrainingView, responses=documented(404, 409))
def choose(body: ChallengeBody, by: Trainer, runtime: TheRuntime) -> TrainingView:
    """Begin an exercise: the machine has this error, and no other, until it is repaired."""
    view = _desk(runtime).choose(body.kind, body.joint, body.size)
    return _recorded(view, by, runtime)


@router.post("/draw", status_code=201, response_model=TrainingView, responses=documented(404, 409))
def draw(body: DrawBody, by: Trainer, runtime: TheRuntime) -> TrainingView:
    """Begin an exercise with a hidden error that is revealed on request or after a run."""
    return _recorded(_desk(runtime).draw(body.groups), by, runtime)


@router.post(
    "/reveal",
    response_model=TrainingView,
    responses=documented(404),
    dependencies=[needs(Permission.MAINTAIN)],
)
def reveal(runtime: TheRuntime) -> TrainingView:
    """Reveal the hidden error."""
    return _desk(runtime).reveal()


@router.post(
    "/repair",
    response_model=TrainingView,
    responses=documented(404),
    dependencies=[needs(Permission.MAINTAIN)],
)
def repair(runtime: TheRuntime) -> TrainingView:
    """Remove every effect and every fault, also those of `/emulator/effects` and `/emulator/faults`."""
    return _desk(runtime).repair()


def _recorded(view: TrainingView, by: Actor, runtime: TheRuntime) -> TrainingView:
    if view.current is not None:  # without its content: the audit is readable while it is hidden
        runtime.store.record(by, "training.begun", f"exercise {view.current.n}")
    return view


def _desk(runtime: TheRuntime) -> TrainingDesk:
    if runtime.training is None:
        raise HTTPException(
            404, "This station has real devices; the training desk is for emulated ones only."
        )
    return runtime.training
