"""Structure: layers without exception, one face a package, no circular imports, short modules."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from pathlib import Path

import grimp
import pytest

ROOT = Path(__file__).parents[1]
ROOTS = ("station", "drivers", "web")
CONTAINERS = ("station.studies",)
"""Packages that only hold packages, each entered by its own face: a study loads much."""
OPEN = ("drivers.emulated", "web")
"""Packages that run as programs of their own; their modules are public."""
MADE = ROOT / "web/client/fivebar_client/models.py"
"""Made from the interface, read by nobody."""
MOST_LINES = 450
MOST_MODULES_IN_STATION = 8
MOST_UNTYPED = 40


@pytest.fixture(scope="module")
def graph() -> grimp.ImportGraph:
    return grimp.build_graph(*ROOTS, cache_dir=None)


def _layers() -> set[str]:
    with (ROOT / "pyproject.toml").open("rb") as file:
        contracts = tomllib.load(file)["tool"]["importlinter"]["contracts"]
    lines = next(c["layers"] for c in contracts if c["type"] == "layers")
    return {name.strip() for line in lines for name in line.split("|")}


def _python() -> Iterator[Path]:
    for root in ROOTS:
        yield from (p for p in (ROOT / root).rglob("*.py") if "node_modules" not in p.parts and p != MADE)


def test_every_package_stands_in_a_layer(graph: grimp.ImportGraph) -> None:
    tops = {child for root in ("station", "drivers") for child in graph.find_children(root)} | {"web"}
    assert tops == _layers()


def test_nothing_imports_in_a_circle(graph: grimp.ImportGraph) -> None:
    for parent in [*ROOTS, *(m for m in graph.modules if graph.find_children(m))]:
        children = graph.find_children(parent)
        reaches = {
            child: {
                other
                for other in children
                if other != child and graph.chain_exists(child, other, as_packages=True)
            }
            for child in children
        }
        circles = {(a, b) for a in children for b in reaches[a] if a in reaches[b]}
        assert not circles, f"{parent}: {sorted(circles)}"


def test_packages_are_entered_by_their_face(graph: grimp.ImportGraph) -> None:
    inner = []
    for importer in graph.modules:
        for imported in graph.find_modules_directly_imported_by(importer):
            parents = imported.split(".")[:-1]
            packages = [".".join(parents[: i + 1]) for i in range(1, len(parents))]
            for package in packages:
                inside = importer == package or importer.startswith(f"{package}.")
                if not inside and package not in CONTAINERS and not package.startswith(OPEN):
                    inner.append(f"{importer} -> {imported}")
    assert not inner


def test_modules_are_short() -> None:
    long = {
        str(p.relative_to(ROOT)): n for p in _python() if (n := len(p.read_text().splitlines())) > MOST_LINES
    }
    assert not long


def test_few_modules_stand_directly_in_station() -> None:
    assert len(list((ROOT / "station").glob("*.py"))) <= MOST_MODULES_IN_STATION


def test_what_travels_between_packages_has_a_type() -> None:
    untyped = [
        f"{path.relative_to(ROOT)}:{number}"
        for path in _python()
        for number, line in enumerate(path.read_text().splitlines(), start=1)
        if re.search(r"dict\[str, Any\]", line)
    ]
    assert len(untyped) <= MOST_UNTYPED, "\n".join(untyped)
