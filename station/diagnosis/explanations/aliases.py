"""Named errors that these readings cannot distinguish: their projected signatures agree to 0.9."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from station.diagnosis.explanations.evidence import Bank, Choice

ALIKE = 0.9
"""Cosine between the fitted signature and the closest one that another error can produce."""


def aliases(bank: Bank, choices: Sequence[Choice], index: int) -> tuple[int, ...]:
    """Families that cannot be distinguished from error `index` of a set, with the others of the set known."""
    others = bank.known([c for k, c in enumerate(choices) if k != index])
    # a part that the others take up is scaled by the square root of the share that they leave
    shrink = 1.0 - np.sqrt(1.0 - others.share)

    def left(columns: np.ndarray) -> np.ndarray:
        return np.asarray(columns - others.directions @ (shrink[:, None] * (others.directions.T @ columns)))

    own = bank.columns(choices[index])
    size = bank.families[choices[index].family].sizes[choices[index].node]
    B = left(own) * size
    white = left(bank.frame.white[:, None])[:, 0]
    signal = B @ np.linalg.solve(np.eye(B.shape[1]) + B.T @ B, B.T @ white)
    signal /= np.linalg.norm(signal) or 1.0
    out = []
    for k, family in enumerate(bank.families):
        if k == choices[index].family or not family.named:
            continue
        X = bank.members(k)
        flat = left(X.reshape(-1, X.shape[2]).T)
        along = (flat.T @ signal).reshape(X.shape[:2])
        gram = np.einsum("vik,vjk->vij", *(2 * [flat.T.reshape(X.shape)]))
        scale = np.einsum("vii->v", gram)[:, None, None] + 1e-300
        inverse = np.linalg.inv(gram + 1e-9 * scale * np.eye(X.shape[1]))
        if np.max(np.einsum("vi,vij,vj->v", along, inverse, along)) > ALIKE**2:
            out.append(k)
    return tuple(out)
