"""Identification from all data: one fit of the measurement model, with all results derived from it.

The same function serves the browser, REST and a file, and every kind of machine. In: a robot, readings,
optionally the knowledge from earlier runs. Out: parameters with uncertainty, residuals, noise, lack of fit.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Generic, TypeVar, overload

import numpy as np

from station.errors import InputRefused
from station.fitting import (
    Noise,
    NotConvergedError,
    Outlier,
    Prior,
    Solution,
    check_outlier_share,
    estimate_noise,
    few_enough,
    find_outliers,
    lack_of_fit,
    position_error_field,
    rms_and_max,
    specified_noise,
    tolerance_prior,
)
from station.five_bar import FiveBar, Robot, check_places
from station.identification.memory import GATE_P, Memory, contradiction_p
from station.identification.references import reference_uses
from station.machines import AnyMechanism, AnyRobot, kind_of, mechanism_of
from station.mechanism import by_reading, reference_of
from station.model import Fit, Model, fit
from station.records import (
    FleetPrior,
    Measurements,
    MountingError,
    PositionError,
    Quantity,
    Real,
    ReferenceUse,
    WeakDirection,
)

LACK_OF_FIT_P = 1e-3
M = TypeVar("M", bound=AnyMechanism)
M_co = TypeVar("M_co", bound=AnyMechanism, covariant=True)


@dataclass(frozen=True, slots=True)
class Gate:
    """Whether the knowledge from earlier calibrations was used, and how well the readings agree with it."""

    used: bool
    p_value: float


@dataclass(frozen=True)
class Identification(Generic[M_co]):
    """One converged fit of the measurement model."""

    mechanism: M_co
    """The machine with the readings that were used; outliers are removed."""
    fit: Fit
    noise: Noise
    sd_factor: float
    """Factor on the uncertainty where the model does not fit (1 when it does)."""
    lack_of_fit_p: float
    outliers: tuple[Outlier, ...]
    gate: Gate | None
    """Test of the knowledge from earlier calibrations; None without any."""
    references: tuple[ReferenceUse, ...] = ()
    """References measured by other instruments, compared with the other data."""
    remembered: tuple[MountingError, ...] = ()
    """Measurements of the mounting that the memory contains."""
    fleet: FleetPrior | None = None
    """The prior from other robots of the type, where it was used."""

    @property
    def measurements(self) -> Measurements:
        """The readings that were used."""
        return self.mechanism.measurements

    @property
    def solution(self) -> Solution:
        return self.fit.solution

    @property
    def p(self) -> Real:
        """(P,) identified parameters, mm and rad."""
        return self.fit.x

    @property
    def covariance(self) -> Real:
        """(P, P) posterior covariance, inflated when the model does not fit."""
        return self.solution.covariance * self.sd_factor**2

    @property
    def dtheta(self) -> Real:
        """(n,) zero offsets, rad."""
        return self.p[: self.measurements.joints]

    @property
    def residual_mm(self) -> Real:
        """(R,) measured less predicted."""
        return self.fit.residual_mm

    @property
    def errors_mm(self) -> Real:
        """(K,) length of each reading's residual."""
        return by_reading(self.mechanism, self.residual_mm)

    @property
    def adequate(self) -> bool:
        """Whether the model fits; False for a fit that stopped early."""
        return self.lack_of_fit_p >= LACK_OF_FIT_P and self.solution.complete

    @property
    def weak_direction(self) -> WeakDirection:
        """The direction of the zero offsets that the readings determine least."""
        kind = kind_of(self.mechanism)
        return kind.weak_direction(self.mechanism, self.solution, self.noise.row_sd, self.sd_factor)

    def moved(self, shift_deg: tuple[float, ...]) -> Identification[M_co]:
        """The same machine seen from drives whose frames have moved: theta before = theta now + shift."""
        x = self.p.copy()
        x[: len(shift_deg)] += np.radians(shift_deg)
        f = self.fit
        return replace(self, fit=Fit(f.model, replace(f.solution, x=x), f.prior, f.row_sd))

    @property
    def lasting(self) -> Memory:
        """The knowledge that this calibration leaves to the next one."""
        parameters = self.mechanism.parameters
        kept = [i for i, parameter in enumerate(parameters) if parameter.lasting]
        names = tuple(parameters[i].name for i in kept)
        measured = tuple(u.reference for u in self.references if isinstance(u.reference, MountingError))
        held = tuple(dict.fromkeys((*self.remembered, *measured)))
        ratio = self.noise.sigma_mm / float(np.sqrt(np.mean(self.mechanism.row_sd**2)))
        return Memory(names, self.p[kept], self.covariance[np.ix_(kept, kept)], ratio, held, self.fleet)

    def quantities(self) -> tuple[Quantity, ...]:
        """Every parameter in shown units with its standard uncertainty.

        Without repeats all uncertainties grow with the misfit, so a parameter that only its tolerance
        determines retains it.
        """
        sd = np.sqrt(np.diag(self.covariance))
        if not self.mechanism.needs_repeats:
            sd = np.minimum(sd, [p.prior_sd for p in self.mechanism.parameters])
        return tuple(
            Quantity(p.name, float(x * p.shown), float(s * p.shown), p.unit)
            for p, x, s in zip(self.mechanism.parameters, self.p, sd, strict=True)
        )

    def modes(self) -> tuple[Quantity, Quantity]:
        """Common and differential mode: half the sum and half the difference of two zero offsets."""
        turn = np.array([[0.5, 0.5], [0.5, -0.5]])
        value = np.degrees(turn @ self.dtheta)
        sd = np.degrees(np.sqrt(np.diag(turn @ self.covariance[:2, :2] @ turn.T)))
        return (
            Quantity("common", float(value[0]), float(sd[0]), "deg"),
            Quantity("differential", float(value[1]), float(sd[1]), "deg"),
        )

    def position_error(self, compensated: bool) -> PositionError | None:
        """Predicted position error over the workspace, mm; None for a machine without a declared one.

        Uncompensated: the identified error itself with its uncertainty. Compensated: the zero offsets taken
        out exactly as identified; the other parameters of the geometry unchanged.
        """
        field = self.position_error_field(compensated)
        return None if field is None else rms_and_max(field)

    def position_error_field(self, compensated: bool) -> Real | None:
        """(G,) the same at each of the workspace's positions."""
        p = self.p.copy()
        if compensated:
            p[: len(self.dtheta)] = 0.0
        errors = self.mechanism.position_errors(p)
        return None if errors is None else position_error_field(*errors, self.covariance)


@overload
def identify(
    robot: Robot, measurements: Measurements, memory: Memory | None = ...
) -> Identification[FiveBar]: ...
@overload
def identify(
    robot: AnyRobot, measurements: Measurements, memory: Memory | None = ...
) -> Identification[AnyMechanism]: ...
def identify(
    robot: AnyRobot, measurements: Measurements, memory: Memory | None = None
) -> Identification[Any]:
    """Fit the measurement model to readings; outliers are found, listed and excluded.

    `memory`, already aged, is the knowledge from earlier calibrations of this robot and mechanism; it is
    dropped if the readings contradict it.

    :raises InputRefused: readings that are impossible for this robot, too few positions, too many outliers,
    no
        convergence, or an impossible result, with the reading or parameter at fault.
    """
    mechanism = mechanism_of(robot, measurements)
    mechanism.check()
    return _identify(mechanism, memory)


def _identify(everything: M, memory: Memory | None) -> Identification[M]:
    _check_enough(everything)
    prior = tolerance_prior(everything)
    specified = everything.row_sd
    plain = _fit(everything, prior, specified)
    left_out = find_outliers(
        everything,
        # this fit is computed once: most readings have no outliers, and it is the start of the result
        lambda sd: (plain if sd is specified else _fit(everything, prior, sd)).solution,
        specified,
    )
    if everything.needs_repeats:
        check_outlier_share(left_out, len(everything.measurements))
    elif not few_enough(left_out, len(everything.measurements)):
        left_out = ()  # its uncertainty grows by the residual
    mechanism, first = everything, plain
    if left_out:
        mechanism = _without(everything, left_out)
        _check_enough(mechanism)
        first = _fit(mechanism, prior, mechanism.row_sd)
    found = _at_noise(mechanism, first, prior, left_out)
    if memory is not None:
        found = _remembering(found, memory)
    if isinstance(mechanism, FiveBar):
        found = replace(found, references=reference_uses(mechanism, found.solution, found.remembered))
    if impossible := mechanism.implausible(found.p):
        raise InputRefused(
            f"Impossible result: {impossible}; check the robot file and the readings' columns, "
            "then run the diagnosis."
        )
    return found


def _remembering(alone: Identification[M], memory: Memory) -> Identification[M]:
    """The same with the knowledge from earlier calibrations, unless the readings contradict it."""
    mechanism, held, reference_p = alone.mechanism, memory.references, 1.0
    if isinstance(mechanism, FiveBar):
        memory, reference_p = memory.informed(mechanism.robot)
    prior = memory.prior(mechanism.parameters)
    first = _fit(mechanism, prior, mechanism.row_sd)
    found = _at_noise(mechanism, first, prior, alone.outliers)
    p_value = min(contradiction_p(found.solution, prior, mechanism.parameters), reference_p)
    if p_value < GATE_P:
        return replace(alone, gate=Gate(False, p_value))
    return replace(found, gate=Gate(True, p_value), remembered=held, fleet=memory.fleet)


def _without(mechanism: M, left_out: tuple[Outlier, ...]) -> M:
    named = {o.reading for o in left_out}
    m = mechanism.measurements
    return mechanism.of(m.take(np.array([i not in named for i in m.ids])))


def _check_enough(mechanism: AnyMechanism) -> None:
    """:raises InputRefused: fewer numbers than unknowns, or too few positions."""
    if mechanism.needs_repeats:
        check_places(mechanism.measurements)
        return
    unknown = sum(not np.isfinite(p.prior_sd) for p in mechanism.parameters) + mechanism.measurements.joints
    if len(mechanism.measured) <= unknown:
        raise InputRefused(
            f"Only {len(mechanism.measured)} numbers were measured for {unknown} unknowns without a "
            "tolerance; measure more poses."
        )


def _at_noise(mechanism: M, found: Fit, prior: Prior, left_out: tuple[Outlier, ...]) -> Identification[M]:
    """The fit at the noise that the repeats show, where there are enough of them.

    :param found: the fit at the specified noise
    """
    noise = specified_noise(mechanism.row_sd)
    if mechanism.needs_repeats:
        noise = estimate_noise(mechanism.measurements, found.solution.residual, mechanism.row_sd)
    if noise.source == "repeats":
        found = _fit(mechanism, prior, noise.row_sd, found.x)
    p_value, ratio = lack_of_fit(found.solution, noise, prior.free, mechanism.measurements)
    return Identification(
        mechanism=mechanism,
        fit=found,
        noise=noise,
        sd_factor=ratio if p_value < LACK_OF_FIT_P or not mechanism.needs_repeats else 1.0,
        lack_of_fit_p=p_value,
        outliers=left_out,
        gate=None,
    )


def _fit(mechanism: AnyMechanism, prior: Prior, row_sd: Real, start: Real | None = None) -> Fit:
    try:
        return fit(Model(mechanism, reference_of(mechanism.measurements)), prior, row_sd, start)
    except NotConvergedError as error:
        raise InputRefused(
            f"The identification cannot start: {error}; check the robot file and that angles and readings "
            "belong together."
        ) from error
