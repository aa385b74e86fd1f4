"""Growth with temperature: of the links, the scale and its mounting."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from station.diagnosis.explanations.family import Family, Hidden, Part, scaled, sizes
from station.diagnosis.explanations.situation import Action, Situation
from station.records import Real


def thermal_families(s: Situation, lengths: Mapping[str, float], *, thermometer: bool) -> tuple[Family, ...]:
    """Links and scale grow with temperature by a material's expansion; the mounting may move either way."""
    if thermometer and s.rise is None:
        return ()
    if s.rise is None:
        span = float(np.ptp(s.t_s)) or 1.0
        hidden: tuple[Hidden, ...] = tuple({"tau_s": float(v)} for v in span * np.geomspace(0.05, 3.0, 10))
    else:
        hidden = ({},)

    def course(s: Situation, hidden: Sequence[Hidden]) -> Real:
        """(V, K, 1) temperature rise, K; if unrecorded, it is one of ten kelvin at the end."""
        out = [10.0 * (1.0 - np.exp(-s.t_s / h["tau_s"])) if "tau_s" in h else s.rise for h in hidden]
        return np.stack([np.zeros(len(s)) if v is None else v for v in out])[:, :, None]

    def links(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        rise = course(s, hidden) * 1e-6
        return [Action(link, rise * mm) for link, mm in lengths.items()]

    def scale(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        return [Action("reading", course(s, hidden) * -1e-6 * s.travel[:, None])]

    def mounting(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        return [Action("reading", course(s, hidden) * 1e-3)]

    share = 1.0 if s.rise is not None else 0.3

    def made(part: str, actions: Callable[[Situation, Sequence[Hidden]], list[Action]], unit: str) -> Family:
        signed = part != "mounting"
        name = f"{part}_{unit.replace('/', '_per_')}"
        range_ = sizes(2.0, 25.0) if signed else sizes(0.1, 50.0)
        own = Part("thermal_growth", None, part, (0,), scaled(name, 1.0, unit))
        return Family("warming", (own,), share, range_, hidden, actions, signed=signed)

    return (
        made("links", links, "um/m/K"),
        made("scale", scale, "um/m/K"),
        made("mounting", mounting, "um/K"),
    )
