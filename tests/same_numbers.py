"""Compare `identify` and `diagnose` of two revisions on every measurement file that both read.

Run in a checkout with the shared data beside it:
`.venv/bin/python -m tests.same_numbers BEFORE [AFTER] [--keep FOLDER]`.  A document that is in FOLDER already
is not made again.  Prints every field that differs, with an instance; exit status 1 if there is one.
"""

from __future__ import annotations

import argparse
import json
import math
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[1]
DATA = ROOT.parent / "shared" / "data"
UR10 = ROOT / "docs" / "examples" / "ur10.toml"
UR5 = """[robot]
serial = "UR5"
model = "serial-dh"
convention = "standard"
a_mm = [0.0, -425.0, -392.25, 0.0, 0.0, 0.0]
d_mm = [89.159, 0.0, 0.0, 109.15, 94.65, 82.3]
alpha_deg = [90.0, 0.0, 0.0, 90.0, -90.0, 0.0]
gravity = [0.0, 0.0, -1.0]
[robot.tolerance]
zero_offset_deg = 1.0
length_mm = 1.0
angle_deg = 0.5
[tool]
position_mm = [0.0, 0.0, 0.0]
sd_mm = 300.0
[instrument]
sd_mm = 0.05
"""
RELATIVE = 1e-9
"""Numbers that agree to this share are the same: sums may be taken in another order."""


@dataclass(frozen=True)
class Case:
    """One command on one file."""

    name: str
    arguments: tuple[str, ...]


def cases(folder: Path) -> Iterator[Case]:
    """Every file of the shared data, with the commands that apply to it."""
    ur5 = folder / "ur5.toml"
    ur5.write_text(UR5, encoding="utf-8")
    for kind in ("undeclared", "hard"):
        for data in sorted((DATA / kind).glob("*.csv")):
            if data.name.endswith(".fresh.csv"):
                continue
            robot = data.with_suffix(".toml")
            options = ("--robot", str(robot)) if robot.exists() else ()
            fresh = data.with_suffix(".fresh.csv")
            name = f"{kind}-{data.stem}"
            yield Case(f"{name}.identify", ("identify", str(data), *options))
            yield Case(f"{name}.diagnose", ("diagnose", str(data), *options))
            yield Case(f"{name}.confirm", ("diagnose", str(data), "--confirm", str(fresh), *options))
    for kind, robot in (("ur10", UR10), ("ur5", ur5)):
        for data in sorted((DATA / kind).glob("*.csv")):
            for measured in ("position", "range"):
                how = ("--robot", str(robot), "--measured", measured)
                name = f"{kind}-{data.stem}-{measured}"
                yield Case(f"{name}.identify", ("identify", str(data), *how))
                yield Case(f"{name}.holdout", ("diagnose", str(data), "--hold-out", *how))


def run(checkout: Path, case: Case, out: Path) -> None:
    """Write the document, or the command's message if it made none."""
    target = out / f"{case.name}.json"
    if target.exists():
        return
    temporary = target.with_suffix(".part")
    done = subprocess.run(
        [sys.executable, "-m", "station", *case.arguments, "--json", str(temporary)],
        cwd=checkout,
        capture_output=True,
        text=True,
        check=False,
    )
    if temporary.exists():
        temporary.rename(target)
    else:
        target.write_text(
            json.dumps({"exit": done.returncode, "said": done.stderr.splitlines()[-1:]}), "utf-8"
        )


def differences(a: object, b: object, at: str = "") -> Iterator[str]:
    """The differences of two documents, field by field."""
    if isinstance(a, dict) and isinstance(b, dict):
        for key in sorted({*a, *b}):
            if key in a and key in b:
                yield from differences(a[key], b[key], f"{at}.{key}")
            else:
                yield f"{at}.{key}: only {'before' if key in a else 'after'}"
    elif isinstance(a, list) and isinstance(b, list):
        if len(a) != len(b):
            yield f"{at}: {len(a)} entries before, {len(b)} after"
        for i, (x, y) in enumerate(zip(a, b, strict=False)):
            yield from differences(x, y, f"{at}[{i}]")
    elif isinstance(a, float | int) and isinstance(b, float | int) and not isinstance(a, bool):
        if not (a == b or math.isclose(a, b, rel_tol=RELATIVE, abs_tol=1e-12) or (a != a and b != b)):
            yield f"{at}: {a!r} before, {b!r} after"
    elif a != b:
        yield f"{at}: {a!r} before, {b!r} after"


def main() -> int:
    """Both revisions, side by side."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("before", help="revision to compare with")
    parser.add_argument("after", nargs="?", help="revision that is compared; without one the work tree")
    parser.add_argument("--keep", type=Path, help="folder for the documents of both")
    options = parser.parse_args()
    folder = options.keep or Path(tempfile.mkdtemp())
    folder.mkdir(parents=True, exist_ok=True)
    sides = {
        name: _checkout(folder / f"{name}-checkout", getattr(options, name)) for name in ("before", "after")
    }
    todo = list(cases(folder))
    for name, checkout in sides.items():
        out = folder / name
        out.mkdir(exist_ok=True)
        with ThreadPoolExecutor(2) as pool:
            list(pool.map(lambda case, c=checkout, o=out: run(c, case, o), todo))
    differ: dict[str, list[str]] = {}
    for case in todo:
        a, b = (json.loads((folder / side / f"{case.name}.json").read_text("utf-8")) for side in sides)
        for line in differences(a, b):
            differ.setdefault(line.partition(": ")[0].partition("[")[0], []).append(f"{case.name}{line}")
    for field, lines in sorted(differ.items()):
        print(f"{field}: {len(lines)} differences, for instance {lines[0]}")
    print(f"{len(todo)} documents compared; kept in {folder}")
    return 1 if differ else 0


def _checkout(folder: Path, revision: str | None) -> Path:
    """A work tree of a revision; for None, that of this script."""
    if revision is None:
        return ROOT
    if not folder.exists():
        subprocess.run(["git", "worktree", "add", "--detach", folder, revision], cwd=ROOT, check=True)
    return folder


if __name__ == "__main__":
    raise SystemExit(main())
