"""Zero offsets and links of a serial arm from its log: one fit of its six errors a link, no effects."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from station.errors import InputRefused
from station.fitting import (
    NotConvergedError,
    Outlier,
    check_outlier_share,
    describe_separability,
    find_outliers,
    tolerance_prior,
)
from station.mechanism import by_reading, reference_of
from station.model import Fit, Model, fit
from station.records import Measurements, Quantity, Real, vars_of
from station.serial_arm import Arm, SerialArm


@dataclass(frozen=True)
class ArmIdentification:
    """One converged fit."""

    fit: Fit
    outliers: tuple[Outlier, ...]

    @property
    def sd_factor(self) -> float:
        """What every sd is widened by: the rest over what is specified, where that is more."""
        return float(np.sqrt(max(self.fit.cost / max(self.fit.dof, 1), 1.0)))

    @property
    def parameters(self) -> tuple[Quantity, ...]:
        """All unknowns in shown units with their standard uncertainty; zero offsets first."""
        tolerance = [p.prior_sd for p in self.fit.model.mechanism.parameters]
        sd = np.minimum(np.sqrt(np.diag(self.fit.solution.covariance)) * self.sd_factor, tolerance)
        return tuple(
            Quantity(p.name, float(x * p.shown), float(s * p.shown), p.unit)
            for p, x, s in zip(self.fit.model.mechanism.parameters, self.fit.x, sd, strict=True)
        )

    @property
    def errors_mm(self) -> Real:
        """(K,) of each reading."""
        return by_reading(self.fit.model.mechanism, self.fit.residual_mm)

    def as_json(self) -> dict[str, Any]:
        """What `station identify --json` writes."""
        mechanism, solution = self.fit.model.mechanism, self.fit.solution
        return {
            "parameters": [vars_of(q) for q in self.parameters],
            "weak_direction": describe_separability(mechanism, solution, self.sd_factor),
            "singular_values": solution.singular_values.tolist(),
            "residual": {
                "rms_mm": float(np.sqrt(np.mean(self.errors_mm**2))),
                "max_mm": float(self.errors_mm.max()),
            },
            "sd_factor": self.sd_factor,
            "outliers": [o.as_json() for o in self.outliers],
            "convergence": {"steps": solution.steps},
        }


def identify_arm(robot: Arm, readings: Measurements) -> ArmIdentification:
    """Fit the links, outlying readings found, named and left out.

    :raises InputRefused: readings that are not of this arm, too few, too many outliers, no convergence.
    """
    mechanism = SerialArm(robot, readings)
    mechanism.check()
    unknowns = len(mechanism.parameters)
    if len(mechanism.measured) <= unknowns:
        raise InputRefused(
            f"Only {len(mechanism.measured)} numbers were measured for {unknowns} unknowns; "
            "measure more poses."
        )
    found = find_outliers(mechanism, lambda sd: _fit(mechanism, sd).solution, mechanism.row_sd)
    check_outlier_share(found, len(readings))
    named = {o.reading for o in found}
    kept = mechanism.of(readings.take(np.array([i not in named for i in readings.ids])))
    return ArmIdentification(_fit(kept, kept.row_sd), found)


def _fit(mechanism: SerialArm, row_sd: Real) -> Fit:
    try:
        return fit(Model(mechanism, reference_of(mechanism.measurements)), tolerance_prior(mechanism), row_sd)
    except NotConvergedError as error:
        raise InputRefused(
            f"The identification did not converge ({error}); check that angles and readings belong together."
        ) from error
