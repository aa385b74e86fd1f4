"""NIST's nonlinear regression problems (StRD, https://www.itl.nist.gov/div898/strd/nls/nls_main.shtml).

The numbers (data, two starts, certified values and standard deviations) are in `nist.json`.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from station.records import Real

STEP = 1e-30
"""Size of the complex step: derivatives to full precision."""

Formula = Callable[[Any, Any], Any]


def _peaks(b: Any, x: Any) -> Any:
    first, second = np.exp(-(((x - b[3]) / b[4]) ** 2)), np.exp(-(((x - b[6]) / b[7]) ** 2))
    return b[0] * np.exp(-b[1] * x) + b[2] * first + b[5] * second


def _decays(b: Any, x: Any) -> Any:
    return b[0] * np.exp(-b[1] * x) + b[2] * np.exp(-b[3] * x) + b[4] * np.exp(-b[5] * x)


def _cubics(b: Any, x: Any) -> Any:
    return (b[0] + x * (b[1] + x * (b[2] + x * b[3]))) / (1.0 + x * (b[4] + x * (b[5] + x * b[6])))


def _seasons(b: Any, x: Any) -> Any:
    year, one, two = (2.0 * np.pi * x / period for period in (12.0, b[3], b[6]))
    yearly = b[1] * np.cos(year) + b[2] * np.sin(year)
    return b[0] + yearly + b[4] * np.cos(one) + b[5] * np.sin(one) + b[7] * np.cos(two) + b[8] * np.sin(two)


def _ultrasonic(b: Any, x: Any) -> Any:
    return np.exp(-b[0] * x) / (b[1] + b[2] * x)


def _growth(b: Any, x: Any) -> Any:
    return b[0] * (1.0 - np.exp(-b[1] * x))


FORMULAS: dict[str, Formula] = {
    "Bennett5": lambda b, x: b[0] * (b[1] + x) ** (-1.0 / b[2]),
    "BoxBOD": _growth,
    "Chwirut1": _ultrasonic,
    "Chwirut2": _ultrasonic,
    "DanWood": lambda b, x: b[0] * x ** b[1],
    "ENSO": _seasons,
    "Eckerle4": lambda b, x: b[0] / b[1] * np.exp(-0.5 * ((x - b[2]) / b[1]) ** 2),
    "Gauss1": _peaks,
    "Gauss2": _peaks,
    "Gauss3": _peaks,
    "Hahn1": _cubics,
    "Kirby2": lambda b, x: (b[0] + x * (b[1] + x * b[2])) / (1.0 + x * (b[3] + x * b[4])),
    "Lanczos1": _decays,
    "Lanczos2": _decays,
    "Lanczos3": _decays,
    "MGH09": lambda b, x: b[0] * (x**2 + x * b[1]) / (x**2 + x * b[2] + b[3]),
    "MGH10": lambda b, x: b[0] * np.exp(b[1] / (x + b[2])),
    "MGH17": lambda b, x: b[0] + b[1] * np.exp(-x * b[3]) + b[2] * np.exp(-x * b[4]),
    "Misra1a": _growth,
    "Misra1b": lambda b, x: b[0] * (1.0 - (1.0 + b[1] * x / 2.0) ** -2),
    "Misra1c": lambda b, x: b[0] * (1.0 - (1.0 + 2.0 * b[1] * x) ** -0.5),
    "Misra1d": lambda b, x: b[0] * b[1] * x / (1.0 + b[1] * x),
    "Nelson": lambda b, x: b[0] - b[1] * x[0] * np.exp(-b[2] * x[1]),
    "Rat42": lambda b, x: b[0] / (1.0 + np.exp(b[1] - b[2] * x)),
    "Rat43": lambda b, x: b[0] / (1.0 + np.exp(b[1] - b[2] * x)) ** (1.0 / b[3]),
    "Roszman1": lambda b, x: b[0] - b[1] * x - np.arctan(b[2] / (x - b[3])) / np.pi,
    "Thurber": _cubics,
}


@dataclass(frozen=True)
class NistProblem:
    """One data set with its formula."""

    name: str
    starts: tuple[Real, Real]
    certified: Real
    sd: Real
    """Certified standard deviations."""
    residual_sd: float
    x: Real
    y: Real

    def residuals(self, b: Real) -> tuple[Real, Real]:
        """(K,) residual over the certified residual standard deviation, and its Jacobian (K, P)."""
        formula = FORMULAS[self.name]
        with np.errstate(all="ignore"):
            r = (formula(b, self.x) - self.y) / self.residual_sd
            J = np.empty((len(r), len(b)))
            for k in range(len(b)):
                aside = b.astype(complex)
                aside[k] += 1j * STEP
                J[:, k] = formula(aside, self.x).imag / STEP / self.residual_sd
        return r, J


def problems() -> dict[str, NistProblem]:
    """Problems by name."""
    out = {}
    for name, data in json.loads(Path(__file__).with_name("nist.json").read_text()).items():
        x, y = np.array(data["x"], dtype=float), np.array(data["y"], dtype=float)
        out[name] = NistProblem(
            name=name,
            starts=(np.array(data["start1"], dtype=float), np.array(data["start2"], dtype=float)),
            certified=np.array(data["certified"]),
            sd=np.array(data["sd"]),
            residual_sd=data["residual_sd"],
            x=x if name == "Nelson" else x[0],
            y=np.log(y) if name == "Nelson" else y,
        )
    return out
