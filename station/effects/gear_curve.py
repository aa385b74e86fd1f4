"""The error of a reducer as a curve: many cycles per turn at once, where single ones are not sufficient."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from station.effects.base import Acts, JointEffect, Variants
from station.effects.cyclic import fastest_seen, waves
from station.mechanism import Conditions
from station.records import Index, Quantity, Real, phrase

HIGHEST = 64
"""Maximum number of cycles per turn."""
FEWEST_READINGS = 3 * HIGHEST
SPREAD_RAD = 3e-4
"""Start of the search for the spread of the amplitudes."""
NAMED = 3
"""Number of strongest waves that are reported,"""
SLOWEST = 4
"""from this number of cycles per turn on."""
MARGIN_RAD = np.radians(30.0)
"""Distance beyond the visited range over which a curve is closed; it has no meaning there."""
KNOWN = 4.0
"""Variance of a curve over its median beyond which it is an extrapolation across a gap."""
GRID = 720


class GearCurve(JointEffect):
    """As `gear_cyclic` with all cycles at once; the size of the amplitudes in each octave is learned too."""

    id = "gear_cyclic"
    physics = phrase("gear_curve_physics")
    remedy = phrase("gear_curve_remedy")
    experiment = phrase("gear_curve_experiment")
    local = True
    covers = ("gear_cyclic", "encoder_eccentricity")

    @property
    def label(self) -> str:
        return f"{self.id} curve of joint {self.joint}"

    def variants(self, c: Conditions) -> Variants | None:
        if len(c) < FEWEST_READINGS:
            return None
        i = self.index
        low, high = float(c.theta[:, i].min()), float(c.theta[:, i].max())
        if high <= low or fastest_seen(c.theta[:, i]) < np.inf:
            return None  # a curve is not visible between the stops of a grid
        hidden = {"from_deg": float(np.degrees(low)), "to_deg": float(np.degrees(high))}
        basis = self.at(hidden, c)
        spread = np.full(basis.shape[1], SPREAD_RAD)
        return Variants(Acts(joint=i), basis[None], (hidden,), 1.0, spread)

    def at(self, hidden: Mapping[str, float], c: Conditions) -> Real:
        return curve_basis(c.theta[:, self.index], _size(hidden))

    def bands(self, size: int) -> Index:
        """Octaves: 1 to 2, 2 to 4, 4 to 8, ... cycles per turn."""
        return np.asarray(np.repeat(np.floor(np.log2(_per_turn(size))), 2), dtype=np.intp)

    def quantities(
        self, hidden: Mapping[str, float], amplitudes: Real, covariance: Real
    ) -> tuple[Quantity, ...]:
        """RMS where the curve is known, then amplitude and cycles per turn of its strongest waves."""
        angle = np.radians(np.linspace(hidden["from_deg"], hidden["to_deg"], GRID))
        basis = curve_basis(angle, len(amplitudes))
        variance = np.einsum("ki,ki->k", basis @ covariance, basis)
        known = variance <= KNOWN * np.median(variance)
        angle, span = angle[known], np.radians(hidden["to_deg"] - hidden["from_deg"])
        basis = fast_basis(angle, len(amplitudes))
        curve = basis @ amplitudes
        sd = np.sqrt(np.mean(np.einsum("ki,ki->k", basis @ covariance, basis)))
        size = np.sqrt(np.mean(curve**2))
        out = [Quantity("rms_deg", float(np.degrees(size)), float(np.degrees(sd)), "deg")]
        for k, (n, along) in enumerate(strongest_waves(angle, curve)):
            number = "" if k == 0 else f"_{k + 1}"
            wave = along @ basis
            amplitude = float(np.hypot(*(wave @ amplitudes)))
            spread = float(np.sqrt(np.trace(wave @ covariance @ wave.T) / 2.0))
            out.append(Quantity(f"amplitude{number}_deg", np.degrees(amplitude), np.degrees(spread), "deg"))
            # Cramer-Rao bound of a frequency seen all over a range (Rife and Boorstyn, IEEE IT-20, 1974)
            out.append(Quantity(f"per_rev{number}", n, np.sqrt(12.0) * spread / amplitude / span, "1/rev"))
        return tuple(out)


def _size(hidden: Mapping[str, float]) -> int:
    """Number of amplitudes: two per wave, and whole numbers of waves over range and margin, to `HIGHEST`."""
    over = np.radians(hidden["to_deg"] - hidden["from_deg"]) + MARGIN_RAD
    return 2 * min(HIGHEST, int(np.ceil(HIGHEST * over / (2.0 * np.pi))))


def _per_turn(size: int) -> Real:
    """(size / 2,) cycles per turn of each wave."""
    count = size // 2
    return np.arange(1, count + 1) * (HIGHEST / count)


def curve_basis(angle: Real, size: int) -> Real:
    """(K, size) cosine and sine of each wave at an angle (K,), rad."""
    return _columns(angle, _per_turn(size))


def _columns(angle: Real, per_turn: Real) -> Real:
    """(K, 2 W) cosine and sine of an angle (K,) times per_turn (W,): 1, 2, ... times its first."""
    turned = waves(angle, per_turn[0], per_turn[0], len(per_turn))
    return np.asarray(turned.transpose(1, 0, 2).reshape(len(angle), -1))


def fast_basis(angle: Real, size: int) -> Real:
    """(K, size) the same without the part that waves slower than `SLOWEST` describe over these angles (K,).

    Below four cycles per turn a curve cannot be distinguished from the arm's geometry.
    """
    basis = curve_basis(angle, size)
    slow = np.column_stack([_columns(angle, np.arange(1.0, SLOWEST)), np.ones(len(angle))])
    return np.asarray(basis - slow @ np.linalg.lstsq(slow, basis, rcond=1e-6)[0])


def strongest_waves(angle: Real, curve: Real) -> list[tuple[float, Real]]:
    """The strongest waves of a curve (G,) over angles (G,): cycles per turn, and factors for their size.

    Least-squares periodogram, one wave taken out after another.  The second of each pair (2, G) times a curve
    is cosine and sine of that wave in it.
    """
    span = float(np.ptp(angle))
    n = np.arange(float(SLOWEST), HIGHEST, np.pi / span / 4.0)
    both = np.exp(1j * n[:, None] * angle)
    rest = curve
    found = []
    for _ in range(NAMED):
        k = int(np.argmax(np.abs(both @ rest)))
        wave = np.column_stack([both[k].real, both[k].imag])
        along = np.linalg.pinv(wave)
        rest = rest - wave @ (along @ rest)
        found.append((float(n[k]), along))
    return found
