"""The error of a reducer as a curve: many cycles a turn at once, where single ones do not suffice."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from station.conditions import Conditions
from station.effects.base import Acts, Effect, Variants
from station.effects.cyclic import waves
from station.kinematics import Real
from station.measurements import Index
from station.records import Quantity

HIGHEST = 64
"""Cycles a turn."""
FEWEST_READINGS = 10 * HIGHEST
SPREAD_RAD = 3e-4
"""Where the search for the spread of the amplitudes begins."""
NAMED = 3
"""Strongest cycles that are named."""
GRID = 720


class GearCurve(Effect):
    """As `gear_cyclic` with all cycles at once; how large those of each octave are is learned too."""

    id = "gear_cyclic"
    physics = (
        "Flexspline, teeth, bearings and encoder repeat their errors in many cycles a turn of the joint."
    )
    remedy = "Keep the curve in the model; check the reducer of the joint if it is larger than its sisters'."
    experiment = "Turn the joint alone through its range in fine steps."
    covers = ("gear_cyclic", "encoder_eccentricity")

    @property
    def label(self) -> str:
        return f"{self.id} curve of joint {self.joint}"

    def variants(self, c: Conditions) -> Variants | None:
        if len(c) < FEWEST_READINGS:
            return None
        i = (self.joint or 1) - 1
        low, high = float(c.theta[:, i].min()), float(c.theta[:, i].max())
        if high <= low:
            return None
        hidden = {"from_deg": float(np.degrees(low)), "to_deg": float(np.degrees(high))}
        spread = np.full(2 * HIGHEST, SPREAD_RAD)
        return Variants(Acts(joint=i), self.at(hidden, c)[None], (hidden,), 1.0, spread)

    def at(self, hidden: Mapping[str, float], c: Conditions) -> Real:
        return curve_basis(c.theta[:, (self.joint or 1) - 1])

    def bands(self, size: int) -> Index:
        """Octaves: 1, 2 to 3, 4 to 7, ... cycles a turn."""
        n = np.repeat(np.arange(1, size // 2 + 1), 2)
        return np.asarray(np.floor(np.log2(n)), dtype=np.intp)

    def quantities(
        self, hidden: Mapping[str, float], amplitudes: Real, covariance: Real
    ) -> tuple[Quantity, ...]:
        """RMS over the visited range, then amplitude and cycles a turn of the strongest cycles."""
        angle = np.radians(np.linspace(hidden["from_deg"], hidden["to_deg"], GRID))
        basis = curve_basis(angle)
        basis = basis - basis.mean(axis=0)
        curve = basis @ amplitudes
        sd = float(np.degrees(np.sqrt(np.mean(np.einsum("ki,ki->k", basis @ covariance, basis)))))
        out = [Quantity("rms_deg", float(np.degrees(np.sqrt(np.mean(curve**2)))), sd, "deg")]
        for k, (n, amplitude) in enumerate(strongest_cycles(angle, curve)):
            number = "" if k == 0 else f"_{k + 1}"
            out.append(Quantity(f"amplitude{number}_deg", float(np.degrees(amplitude)), sd, "deg"))
            out.append(Quantity(f"per_rev{number}", n, 0.0, "1/rev"))
        return tuple(out)


def curve_basis(angle: Real) -> Real:
    """(K, 2 HIGHEST) cosine and sine of 1, 2, ... times an angle (K,), rad."""
    return np.asarray(waves(angle, 1.0, 1.0, HIGHEST).transpose(1, 0, 2).reshape(len(angle), -1))


def strongest_cycles(angle: Real, curve: Real) -> list[tuple[float, float]]:
    """Cycles a turn and amplitude of the strongest waves in a curve (G,) over angles (G,), one after another.

    Least-squares periodogram over the visited range, from one and a half periods in it on.
    """
    span = float(np.ptp(angle))
    n = np.arange(max(1.0, 3.0 * np.pi / span), HIGHEST, np.pi / span / 4.0)
    both = np.exp(1j * n[:, None] * angle)
    rest = curve - curve.mean()
    found = []
    for _ in range(NAMED):
        best = int(np.argmax(np.abs(both @ rest)))
        wave = np.column_stack([both[best].real, both[best].imag, np.ones(len(angle))])
        fitted = np.linalg.lstsq(wave, rest, rcond=None)[0]
        rest = rest - wave @ fitted
        found.append((float(n[best]), float(np.hypot(*fitted[:2]))))
    return found
