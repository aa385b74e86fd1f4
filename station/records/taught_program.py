"""Joint targets in a controller's program: KRL (KUKA) and RAPID (ABB), whose makers document them.

In both an axis angle is a decimal number in degrees, and the robot's first two axes are joints 1 and 2.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from station.errors import InputRefused
from station.records.taught import TaughtPosition, TranslatedPosition, read_taught

NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
UNDEFINED = 1e6
"""An angle from here on is no angle: RAPID writes 9E9 for an axis that is not connected."""
KRL = re.compile(
    r"(?:(?P<name>[\w$]+(?:\[\d+\])?)\s*=\s*|\bPTP\s+)\{(?P<axes>[^{}\n]*\bA[12]\s[^{}\n]*)\}", re.I
)
KRL_AXIS = re.compile(rf"\b(?P<axis>A[12])\s+(?P<value>{NUMBER})\s*(?=,|$)", re.I)
RAPID = re.compile(
    r"(?:\bjointtarget\s+(?P<name>\w+)\s*:=|\bMoveAbsJ\b[^\[;\n]*)\s*\[\s*\[(?P<axes>[^\]]*)\]", re.I
)
RAPID_AXIS = re.compile(rf"(?P<value>{NUMBER})\s*(?=,|$)")
COMMENT = {KRL: ";", RAPID: "!"}

Span = tuple[int, int]


@dataclass(frozen=True)
class TaughtProgram:
    """The joint targets of a program, and where its text states their angles."""

    text: str
    positions: tuple[TaughtPosition, ...]
    spans: tuple[tuple[Span, Span], ...]

    def rewritten(self, positions: Sequence[TranslatedPosition]) -> str:
        """The same text with other angles."""
        parts, done = [], 0
        for spans, position in zip(self.spans, positions, strict=True):
            for (start, end), degrees in sorted(
                zip(spans, (position.theta1_deg, position.theta2_deg), strict=True)
            ):
                parts += [self.text[done:start], f"{degrees:.6f}"]
                done = end
        return "".join([*parts, self.text[done:]])


def read_taught_file(text: str, source: str) -> tuple[tuple[TaughtPosition, ...], TaughtProgram | None]:
    """Positions of a CSV file or a program, and the program if it is one.

    :raises InputRefused: as `read_taught`, or an angle of a joint target is missing; with its line.
    """
    program = _program(text, source)
    return (program.positions, program) if program else (read_taught(text, source), None)


def _program(text: str, source: str) -> TaughtProgram | None:
    for language, find in ((KRL, _krl_axes), (RAPID, _rapid_axes)):
        positions, spans = [], []
        for target in language.finditer(text):
            if COMMENT[language] in text[text.rfind("\n", 0, target.start()) + 1 : target.start()]:
                continue
            line = text.count("\n", 0, target.start()) + 1
            axes = dict(find(target))
            name = target["name"] or f"line {line}"
            for axis in (1, 2):
                if axis not in axes or abs(float(text[slice(*axes[axis])])) >= UNDEFINED:
                    raise InputRefused(
                        f"{source}: line {line}: {name} has no angle of axis {axis}; both are needed."
                    )
            first, second = axes[1], axes[2]
            positions.append(
                TaughtPosition(
                    position=name,
                    theta1_deg=float(text[slice(*first)]),
                    theta2_deg=float(text[slice(*second)]),
                )
            )
            spans.append((first, second))
        if positions:
            return TaughtProgram(text, tuple(positions), tuple(spans))
    return None


def _krl_axes(target: re.Match[str]) -> Iterator[tuple[int, Span]]:
    """Axis and the place of its angle; KRL names each axis."""
    start = target.start("axes")
    for found in KRL_AXIS.finditer(target["axes"]):
        yield int(found["axis"][1]), (start + found.start("value"), start + found.end("value"))


def _rapid_axes(target: re.Match[str]) -> Iterator[tuple[int, Span]]:
    """Axis and the place of its angle; RAPID lists all six in order."""
    start = target.start("axes")
    for axis, found in enumerate(RAPID_AXIS.finditer(target["axes"]), start=1):
        yield axis, (start + found.start("value"), start + found.end("value"))
