"""Reading by reading: each is predicted before it is used, and the prediction is its verification.

The next position is chosen by the effect of one more reading on the covariance (rank-one update), so hundreds
of candidates cost microseconds each.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.special import chdtrc

from station.fitting import Prior, specified_noise, tolerance_prior
from station.five_bar import FiveBar, Robot, inverse
from station.identification.estimate import Gate, Identification
from station.identification.memory import Memory, contradiction_p
from station.identification.references import reference_uses
from station.mechanism import Parameter, reference_of
from station.model import Model, fit
from station.records import Complex, MountingError, Reading, Real, from_readings

FLAT_PRIOR_SD_MM = 1e3
"""Prior of an unknown reading offset while predicting; a wider one loses digits."""


@dataclass(frozen=True)
class Innovation:
    """One reading less its prediction before it was used."""

    residual_mm: float
    sd_mm: float
    """Standard deviation of the prediction, including noise."""


@dataclass(frozen=True)
class Known:
    """The knowledge of a robot after some readings, or none."""

    robot: Robot
    readings: tuple[Reading, ...] = ()
    memory: Memory | None = None
    innovations: tuple[Innovation, ...] = ()
    samples: int = 1
    """Number of samples of a further reading."""

    def absorb(self, reading: Reading) -> Known:
        """The knowledge with one more reading, which is predicted first."""
        innovations = (*self.innovations, self._innovation(reading))
        return replace(self, readings=(*self.readings, reading), innovations=innovations)

    def without_memory(self) -> Known:
        """The same readings, one after another, without the memory."""
        known = Known(self.robot, samples=self.samples)
        for reading in self.readings:
            known = known.absorb(reading)
        return known

    @property
    def measured_before(self) -> bool:
        """Whether the memory comes from a run of this robot, and not from others of its type."""
        return self.memory is not None and "rMx" in self.memory.names

    @cached_property
    def noise_ratio(self) -> float:
        """Noise of a reading over its specification, from the run that left the memory."""
        return self.memory.noise_ratio if self.memory else 1.0

    @cached_property
    def found(self) -> Identification[FiveBar]:
        """The fit of all readings; only where there is one."""
        mechanism = FiveBar(self.robot, from_readings(self.readings))
        prior = self._prior(mechanism)
        row_sd = mechanism.row_sd * self.noise_ratio
        result = fit(Model(mechanism, reference_of(mechanism.measurements)), prior, row_sd)
        gate: Gate | None = None
        held: tuple[MountingError, ...] = ()
        if self.memory is not None:
            p_value = contradiction_p(result.solution, prior, mechanism.parameters)
            gate, held = Gate(True, p_value), self.memory.references
        return Identification(
            mechanism=mechanism,
            fit=result,
            noise=specified_noise(row_sd),
            sd_factor=1.0,
            # the squares of the innovations add up to the cost (Kalman), apart from curvature
            lack_of_fit_p=float(chdtrc(len(row_sd) - prior.free, result.cost)) if len(row_sd) > 1 else 1.0,
            outliers=(),
            gate=gate,
            references=reference_uses(mechanism, result.solution, held),
            remembered=held,
            fleet=self.memory.fleet if self.memory else None,
        )

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """The unknowns of one mount."""
        return self._nowhere.parameters

    @cached_property
    def estimate(self) -> Real:
        """(P,) current estimate of the parameters, mm and rad."""
        return self.found.p if self.readings else self._prior(self._nowhere).mean

    @cached_property
    def covariance(self) -> Real:
        """(P, P); the reading offset is very wide before the first reading."""
        if self.readings:
            return self.found.solution.covariance
        root = self._prior(self._nowhere).root
        information = root.T @ root
        flat = np.diag(information) == 0.0
        information[flat, flat] = 1.0 / FLAT_PRIOR_SD_MM**2
        return np.asarray(np.linalg.inv(information))

    def rows(self, places: Complex) -> Real:
        """(N, P) whitened derivatives of one reading at each of positions (N,), at the current estimate."""
        theta = inverse(self.robot.geometry, places) - self.estimate[:2]
        mechanism = self._at(theta)
        at = mechanism.observe(self.estimate, theta)
        return np.asarray(at.by_parameter / (mechanism.row_sd * self.noise_ratio)[:, None])

    def position_jacobian(self) -> tuple[Real, Real]:
        """Position errors over the workspace: (G, 2) with the zeros taken out, derivatives (G, 2, P)."""
        p = self.estimate.copy()
        p[:2] = 0.0
        return self._nowhere.position_errors(p)

    def _innovation(self, reading: Reading) -> Innovation:
        one = FiveBar(self.robot, from_readings([reading]))
        at = one.observe(self.estimate, one.theta)
        noise = float((one.row_sd * self.noise_ratio)[0]) ** 2
        told = float(at.by_parameter[0] @ self.covariance @ at.by_parameter[0])
        sd = float(np.sqrt(told + noise))
        return Innovation(float(one.measured[0] - at.value[0]), sd)

    def _prior(self, mechanism: FiveBar) -> Prior:
        return self.memory.prior(mechanism.parameters) if self.memory else tolerance_prior(mechanism)

    @cached_property
    def _nowhere(self) -> FiveBar:
        return self._at(inverse(self.robot.geometry, self.robot.workspace_grid(1, 1)))

    def _at(self, theta: Real) -> FiveBar:
        readings = [
            Reading(k + 1, 0.0, (float(a), float(b)), (0, 0), 0.0, str(k), samples_mm=(0.0,) * self.samples)
            for k, (a, b) in enumerate(np.degrees(theta))
        ]
        return FiveBar(self.robot, from_readings(readings))
