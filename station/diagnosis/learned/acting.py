"""What commands have to know of an effect: where it holds, and on what it depends."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Acting:
    """One effect of a learned model."""

    label: str
    joints: tuple[int, ...] = ()
    """Joints that must have been where they are commanded to."""
    by_approach: tuple[int, ...] = ()
    """Joints whose side of approach has to be given."""
    by_payload: bool = False
    """Whether the payload has to be given."""
