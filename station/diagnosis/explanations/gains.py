"""Gain and determinant of many linear-Gaussian errors at once."""

from __future__ import annotations

import numpy as np

from station.records import Real


def gain_and_log_det(gram: Real, along: Real, precision: Real) -> tuple[Real, Real]:
    """Gain and log determinant (V, T) for Gram matrices (V, q, q), b (V, q) and size^-2 (V, T)."""
    width = gram.shape[1]
    if width == 1:
        S = np.maximum(gram[:, :, 0], 0.0)
        return 0.5 * along**2 / (S + precision), np.log1p(S / precision)
    if width == 2:
        a, c = gram[:, 0, 0, None] + precision, gram[:, 1, 1, None] + precision
        b = gram[:, 0, 1, None]
        det = a * c - b * b
        x, y = along[:, :1], along[:, 1:]
        return 0.5 * (c * x * x - 2.0 * b * x * y + a * y * y) / det, np.log(det) - 2.0 * np.log(precision)
    values, vectors = np.linalg.eigh(gram)
    values = np.maximum(values, 0.0)[:, :, None]
    turned = np.einsum("vij,vi->vj", vectors, along)[:, :, None]
    k = precision[:, None, :]
    return 0.5 * np.sum(turned**2 / (values + k), axis=1), np.sum(np.log1p(values / k), axis=1)
