"""Whether something jumped during a calibration, and at which reading: the readout, or a joint's zero.

Lost counts of the readout shift every later reading by the same amount, a slipped joint every later angle; a
collision may do it to both joints, or twice.  The smooth model takes up part of that, and repeats before and
after it make the noise look large, so a run may look correct; jumps at one or a few readings, beside the
model, then explain the residual far better.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.special import chdtrc

from station.errors import InputRefused
from station.five_bar import FiveBar, Robot
from station.records import CalibrationResult, JumpNote, Reading, Real, Reason, because, from_readings

LEAST_MM = 0.03
"""RMS shift of the readings by a jump; a smaller one may be creep or warming."""
READOUT = 0
"""Number of the readout, beside joints 1 and 2."""
THINGS = (READOUT, 1, 2)
JOINTS: dict[int, Literal["joint 1", "joint 2"]] = {1: "joint 1", 2: "joint 2"}
MOST_MOMENTS = 3
_SIZE_SD = np.array([10.0, np.radians(10.0), np.radians(10.0)])
"""Prior of the jumps, mm and rad: it limits those about which the readings have no information."""
_ITERATIONS = 8
_SETTLED_SDS = 1e-3
"""A step that changes no row by more than this is the last one."""
_DOUBT_P = 1e-3
_LEAST_GAIN = 30.0
"""Minimum gain in chi-square by a jump."""
_FITS = 4.0
"""Largest chi-square per degree of freedom that jumps may leave."""
_FEW = 40
"""Number of readings; with fewer, several jumps at once explain almost anything."""
_AS_WELL = 20.0
"""Difference in chi-square below which a jump of another quantity explains the readings as well."""


@dataclass(frozen=True, slots=True)
class Jump:
    """A jump between two readings."""

    index: int
    """Index of the first reading after it; after the first jump, if there are several."""
    thing: int | None
    """`READOUT` or the joint; None: several, or the readings do not determine which."""
    size: float
    """Size in mm for the readout, rad for the joint."""

    def reason(self, reading: int | str, position: str) -> Reason:
        """The jump in words, for a first reading after it with this number and position."""
        if self.thing is None:
            return because("something_jumped", reading=reading, position=position)
        if self.thing == READOUT:
            size_um = round(self.size * 1e3, 1)
            return because("readout_jumped", reading=reading, position=position, jump_um=size_um)
        slip_deg = round(float(np.degrees(self.size)), 4)
        return because(
            "joint_slipped", reading=reading, position=position, joint=self.thing, slip_deg=slip_deg
        )

    def note(self, reading: int | str) -> JumpNote:
        """The jump as documents contain it."""
        if self.thing is None:
            text = f"Something jumped at reading {reading}: the readout or a joint."
            return JumpNote(reading=reading, thing=None, text=text)
        if self.thing == READOUT:
            text = f"The readout jumped by {self.size * 1e3:+.1f} um at reading {reading}."
            return JumpNote(reading=reading, thing="readout", size_mm=self.size, text=text)
        size_deg = float(np.degrees(self.size))
        text = f"Joint {self.thing} slipped by {size_deg:+.4f} deg at reading {reading}."
        return JumpNote(reading=reading, thing=JOINTS[self.thing], size_deg=size_deg, text=text)


Jumps = tuple[tuple[int, tuple[int, ...]], ...]
"""First reading after each jump, and the quantities that may have jumped there."""


@dataclass(frozen=True)
class _Fitted:
    """The model with all knowledge of the machine, and with jumps."""

    jumps: Jumps
    left: Real
    """(K + Q,) residual of the readings and of the prior knowledge, in standard deviations."""
    by_parameter: Real
    """(K + Q, P) derivatives; the jumps come last."""
    sizes: Real
    """(J,) sizes of the jumps, mm and rad."""

    @property
    def square(self) -> float:
        return float(self.left @ self.left)


def find_jump(mechanism: FiveBar) -> Jump | None:
    """The jump that explains why readings contradict the model; None if they do not, or not because of jumps.

    The geometry is free within its tolerances, the noise is that of the robot file.
    """
    found = _fitted(mechanism, ())
    dof = len(found.left) - np.linalg.matrix_rank(found.by_parameter)
    if not np.isfinite(found.square) or chdtrc(dof, found.square) > _DOUBT_P:
        return None
    single = _single(mechanism, found, _FITS * dof)
    if single is not None or len(mechanism.row_sd) < _FEW:
        return single
    moments: tuple[int, ...] = ()
    while len(moments) < MOST_MOMENTS and found.square > _FITS * dof:
        more = _settled(mechanism, (*moments, _moment(mechanism, found)))
        fitted = _fitted(mechanism, _anything_at(more))
        if not found.square - fitted.square > _LEAST_GAIN:
            return None
        moments, found = more, fitted
    large = all(_shift_mm(mechanism, found, moment) > LEAST_MM for moment in moments)
    return Jump(min(moments), None, 0.0) if moments and large and found.square <= _FITS * dof else None


def without_jump(result: CalibrationResult, robot: Robot, readings: Sequence[Reading]) -> CalibrationResult:
    """The result, or a failed one that names the reading at which something jumped."""
    try:
        jump = find_jump(FiveBar(robot, from_readings(list(readings))))
    except InputRefused:
        return result
    if jump is None:
        return result
    first = readings[jump.index]
    reason = jump.reason(first.reading, first.position)
    changed = {
        "verdict": "fail",
        "outcome": "unexplained",
        "reason": reason,
        "lack_of_fit": reason.text,
        "lack_of_fit_reason": reason,
    }
    return result.model_copy(update=changed)


def _single(mechanism: FiveBar, without: _Fitted, limit: float) -> Jump | None:
    """One jump of one quantity, if it leaves a chi-square below `limit`."""
    last = len(mechanism.row_sd) - 1
    best = []
    for thing in THINGS:
        k = _moment(mechanism, without, (thing,))
        beside = range(max(1, k - 1), min(last, k + 1) + 1)
        best.append(min((_fitted(mechanism, ((n, (thing,)),)) for n in beside), key=_square))
    first, second, _ = sorted(best, key=_square)
    ((index, (thing,)),) = first.jumps
    if without.square - first.square < _LEAST_GAIN or first.square > limit:
        return None
    if _shift_mm(mechanism, first, index) <= LEAST_MM:
        return None
    told = second.square > first.square + _AS_WELL
    return Jump(index, thing if told else None, float(first.sizes[0]))


def _anything_at(moments: Sequence[int]) -> Jumps:
    return tuple((moment, THINGS) for moment in moments)


def _settled(mechanism: FiveBar, moments: tuple[int, ...]) -> tuple[int, ...]:
    """Each moment searched again beside the others."""
    for i in range(len(moments) if len(moments) > 1 else 0):
        others = moments[:i] + moments[i + 1 :]
        again = _moment(mechanism, _fitted(mechanism, _anything_at(others)))
        moments = moments if again in others else (*moments[:i], again, *moments[i + 1 :])
    return moments


def _moment(mechanism: FiveBar, found: _Fitted, things: tuple[int, ...] = THINGS) -> int:
    """First reading after the jump with the largest gain, linear about a fit."""
    count = len(mechanism.row_sd)
    basis, _ = np.linalg.qr(found.by_parameter)
    later = np.tril(np.ones((count, count)))
    by_thing = np.column_stack([1.0 / mechanism.row_sd, found.by_parameter[:count, :2]])
    jumps = np.zeros((len(found.left), count, len(things)))
    jumps[:count] = later[:, :, None] * by_thing[:, None, list(things)]
    flat = jumps.reshape(len(found.left), -1)
    jumps = (flat - basis @ (basis.T @ flat)).reshape(jumps.shape)
    along = np.einsum("rkt,r->kt", jumps, found.left)
    square = np.einsum("rkt,rku->ktu", jumps, jumps) + np.diag(_SIZE_SD[list(things)] ** -2.0)
    gains = np.einsum("kt,kt->k", along, np.linalg.solve(square, along[:, :, None])[:, :, 0])
    gains[0] = 0.0  # a jump before the first reading is the unknown offset
    return int(np.argmax(gains))


def _shift_mm(mechanism: FiveBar, found: _Fitted, moment: int) -> float:
    """RMS effect of the jump at this moment on the readings after it."""
    at = np.cumsum([0, *(len(things) for _, things in found.jumps)])
    n = [index for index, _ in found.jumps].index(moment)
    first = found.by_parameter.shape[1] - at[-1] + at[n]
    columns = found.by_parameter[moment : len(mechanism.row_sd), first : first + at[n + 1] - at[n]]
    shift = columns @ found.sizes[at[n] : at[n + 1]] * mechanism.row_sd[moment:]
    return float(np.sqrt(np.mean(shift**2)))


def _fitted(mechanism: FiveBar, jumps: Jumps) -> _Fitted:
    """The best fit with these jumps; its sum of squares is not finite where there is none."""
    p, things = mechanism.start, [(index, thing) for index, some in jumps for thing in some]
    sizes = np.zeros(len(things))
    prior_sd = np.array([parameter.prior_sd for parameter in mechanism.parameters])
    known = np.isfinite(prior_sd)
    pull = np.eye(len(p))[known] / prior_sd[known, None]
    bound = np.diag([1.0 / _SIZE_SD[thing] for _, thing in things]).reshape(len(things), len(things))
    sd, number = mechanism.row_sd, np.arange(len(mechanism.row_sd))
    later = np.array([number >= index for index, _ in things], dtype=float).reshape(len(things), len(sd))
    for _ in range(_ITERATIONS):
        theta, off = mechanism.theta.copy(), mechanism.measured.copy()
        for (_, thing), size, after in zip(things, sizes, later, strict=True):
            if thing == READOUT:
                off -= size * after
            else:
                theta[:, thing - 1] += size * after
        at = mechanism.observe(p, theta)
        by_parameter = np.zeros((len(sd) + len(pull) + len(things), len(p) + len(things)))
        by_parameter[: len(sd), : len(p)] = at.by_parameter / sd[:, None]
        for column, ((_, thing), after) in enumerate(zip(things, later, strict=True), len(p)):
            moves = 1.0 if thing == READOUT else at.by_parameter[:, thing - 1]
            by_parameter[: len(sd), column] = moves * after / sd
        by_parameter[len(sd) : len(sd) + len(pull), : len(p)] = pull
        by_parameter[len(sd) + len(pull) :, len(p) :] = bound
        left = np.concatenate([(off - at.value) / sd, pull @ (mechanism.start - p), -bound @ sizes])
        if not np.isfinite(left).all() or not np.isfinite(by_parameter).all():
            return _Fitted(jumps, np.full_like(left, np.inf), np.zeros_like(by_parameter), sizes)
        step = np.linalg.lstsq(by_parameter, left, rcond=None)[0]
        p, sizes = p + step[: len(p)], sizes + step[len(p) :]
        if np.abs(by_parameter @ step).max() < _SETTLED_SDS:
            break
    return _Fitted(jumps, left, by_parameter, sizes)


def _square(fitted: _Fitted) -> float:
    return fitted.square
