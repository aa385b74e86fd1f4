"""The result of `make mutate`: killed mutants by module, and those that no test notices.

A mutant of the store that only changes the case of SQL or of a column name is the same program for SQLite;
such mutants are counted separately.  Exit status 1: the share of killed mutants of a module is below the
limit.
"""

from __future__ import annotations

import json
import re
import sys
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

LEAST_KILLED = 0.9
KILLED, SURVIVED, UNTRIED, SAME = "killed", "survived", "not tried", "same program"
_STATUS = {1: KILLED, 3: KILLED, 0: SURVIVED, 5: SURVIVED, 33: SURVIVED, None: UNTRIED}
"""By exit status of the tests; every other one is a test run that was ended by its time limit."""
_DEFINITION = re.compile(r"\s*(?:async )?def (\S+?__mutmut_(?:orig|\d+))\(")


@dataclass(frozen=True)
class Mutant:
    """One changed line or expression."""

    name: str
    status: str
    before: str
    after: str


def functions(source: str) -> dict[str, list[str]]:
    """The lines of each original and mutant by its name in the generated module."""
    found: dict[str, list[str]] = {}
    lines: list[str] | None = None
    for line in source.splitlines():
        if match := _DEFINITION.match(line):
            lines = found.setdefault(match[1], [])
            line = line.replace(match[1], "")
        elif line.lstrip().startswith("@") or (line and not line.startswith((" ", ")"))):
            lines = None
        if lines is not None:
            lines.append(line.strip())
    return found


def mutants(meta: Path) -> list[Mutant]:
    """Mutants of one module, from the files of the mutation tester."""
    statuses: dict[str, int | None] = json.loads(meta.read_text())["exit_code_by_key"]
    bodies = functions(meta.with_suffix("").read_text())
    found = []
    for key, code in statuses.items():
        name = key.rpartition(".")[2]
        original, changed = bodies[re.sub(r"\d+$", "orig", name)], bodies[name]
        before = " ".join(line for line in original if line not in changed)
        after = " ".join(line for line in changed if line not in original)
        status = _STATUS.get(code, KILLED)
        if status == SURVIVED and "store" in meta.parts and before.lower() == after.lower():
            status = SAME
        found.append(Mutant(name, status, before, after))
    return found


def main(folder: Path) -> int:
    """Print the table and the survivors; the exit status."""
    poor = False
    for meta in sorted(folder.rglob("*.meta")):
        found = mutants(meta)
        counts = Counter(mutant.status for mutant in found)
        tried = counts[KILLED] + counts[SURVIVED]
        if not tried:
            continue
        share = counts[KILLED] / tried
        poor = poor or share < LEAST_KILLED
        print(
            f"{meta.relative_to(folder).with_suffix('')}: {counts[KILLED]} of {tried} killed ({share:.1%})",
            end="",
        )
        print("".join(f", {counts[kind]} {kind}" for kind in (SAME, UNTRIED) if counts[kind]))
        for mutant in found:
            if mutant.status == SURVIVED:
                print(f"  {mutant.name}\n    - {mutant.before}\n    + {mutant.after}")
    return int(poor)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1] if len(sys.argv) > 1 else "mutants")))
