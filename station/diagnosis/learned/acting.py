"""The facts about an effect that commands need: where it is valid, and what it depends on."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Acting:
    """One effect of a learned model."""

    label: str
    joints: tuple[int, ...] = ()
    """Joints whose command must lie in the range they visited."""
    by_approach: tuple[int, ...] = ()
    """Joints whose side of approach has to be given."""
    by_payload: bool = False
    """Whether the payload has to be given."""
