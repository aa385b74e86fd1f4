"""Links beyond their tolerance, and clearance in the passive joints."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from station.effects.base import Acts, JointEffect, Variants, one, scaled
from station.mechanism import Conditions
from station.records import Quantity, Real, phrase


class LinkLength(JointEffect):
    id = "link_length"
    physics = phrase("link_length_physics")
    remedy = phrase("link_length_remedy")
    experiment = phrase("link_length_experiment")

    def __init__(self, joint: int, link: str) -> None:
        super().__init__(joint)
        self.link = link
        """Parameter name: L1, l1, ..."""

    @property
    def label(self) -> str:
        return f"{self.id} {self.link}"

    def variants(self, c: Conditions) -> Variants | None:
        if self.link not in c.lengths:
            return None
        return one(Acts(lengths={self.link: 1.0}), np.ones(len(c)))

    def quantities(
        self, hidden: Mapping[str, float], amplitudes: Real, covariance: Real
    ) -> tuple[Quantity, ...]:
        return (scaled(self.link, amplitudes[0], covariance[0, 0], 1.0, "mm"),)


class JointClearance(JointEffect):
    id = "joint_clearance"
    physics = phrase("joint_clearance_physics")
    remedy = phrase("joint_clearance_remedy")
    experiment = phrase("joint_clearance_experiment")

    def variants(self, c: Conditions) -> Variants | None:
        link = f"l{self.joint}"
        if link not in c.lengths:
            return None
        return one(Acts(lengths={link: 1.0}), c.pull[:, self.index])

    def quantities(
        self, hidden: Mapping[str, float], amplitudes: Real, covariance: Real
    ) -> tuple[Quantity, ...]:
        return (scaled("mm", amplitudes[0], covariance[0, 0], 1.0, "mm"),)
