"""The code of tutorials and guides is carried out as a reader would: in order, with nothing else at hand.

A page that names files of the repository works in a copy of it, any other page in an empty folder.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.docs.pages import ROOT, Block, blocks, with_code

pytestmark = pytest.mark.long

TREES = ("station", "drivers", "web", "tests")
COMMANDS = {
    "station": "import runpy, sys; sys.argv[0] = 'station'; runpy.run_module('station', run_name='__main__')",
    "pytest": "import sys, pytest; sys.exit(pytest.main(['-p', 'no:cacheprovider', *sys.argv[1:]]))",
    "sqlite3": (
        "import sqlite3, sys; rows = sqlite3.connect(sys.argv[1]).execute(sys.argv[2]);"
        " [print('|'.join(str(v) for v in row)) for row in rows]"
    ),
}
"""What a reader has installed, run by this interpreter."""
STATUS = re.compile(r"  # exit status (\d)$")


@pytest.mark.timeout(400)
@pytest.mark.parametrize("page", with_code(), ids=lambda p: p.stem)
def test_the_code_of_a_page_works(page: Path, tmp_path: Path) -> None:
    found = list(blocks(page))
    if any(block.name.partition("/")[0] in TREES for block in found):
        copy_of_the_repository(tmp_path)
    environment = _environment(tmp_path)
    for block in found:
        where = f"{page.relative_to(ROOT)}, line {block.line}"
        if block.kind == "console":
            for command, status, expected in _commands(block):
                _run(command, status, expected, tmp_path, environment, where)
        elif block.kind == "diff":
            change(tmp_path / block.name, block.body, where)
        else:
            file = tmp_path / block.name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(block.body, encoding="utf-8")


def copy_of_the_repository(folder: Path) -> None:
    for tree in TREES:
        shutil.copytree(
            ROOT / tree,
            folder / tree,
            ignore=shutil.ignore_patterns("node_modules", "static", "ui"),
        )
    texts = "web/ui/src/messages"
    shutil.copytree(ROOT / texts, folder / texts)
    shutil.copy(ROOT / "pyproject.toml", folder)


def _environment(folder: Path) -> dict[str, str]:
    commands = folder / ".commands"
    commands.mkdir()
    for name, code in COMMANDS.items():
        script = commands / name
        script.write_text(f"#!{sys.executable}\n{code}\n", encoding="utf-8")
        script.chmod(0o755)
    source = folder if (folder / "station").is_dir() else ROOT
    return {
        **os.environ,
        "PATH": f"{commands}{os.pathsep}{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}",
        "PYTHONPATH": str(source),
        "STATION_HOME": str(folder / "home"),
        "COLUMNS": "200",
    }


def _commands(block: Block) -> list[tuple[str, int, list[str]]]:
    """Each command with its exit status and the lines that it is said to print."""
    out: list[tuple[str, int, list[str]]] = []
    for line in block.body.splitlines():
        if line.startswith("$ "):
            status = STATUS.search(line)
            out.append((STATUS.sub("", line[2:]), int(status[1]) if status else 0, []))
        elif line.strip() and line.strip() != "...":
            out[-1][2].append(line)
    return out


def _run(
    command: str, status: int, expected: list[str], folder: Path, environment: dict[str, str], where: str
) -> None:
    done = subprocess.run(
        ["/bin/sh", "-c", command],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        timeout=300,
        stdin=subprocess.DEVNULL,
    )
    output = done.stdout + done.stderr
    assert done.returncode == status, f"{where}: {command}\n{output}"
    said = _plain(output)
    for line in expected:
        pattern = re.sub(r"\d+(\\\.\d+)?(e\\?[+-]?\d+)?", r"[-+\\d.e]+", re.escape(_plain(line)))
        pattern = pattern.replace(re.escape("..."), ".*")
        assert re.search(pattern, said), f"{where}: {command}\nno line like {line!r} in\n{output}"


def _plain(text: str) -> str:
    """Numbers differ between runs, tables between terminals; words do not."""
    return " ".join(re.sub(r"[^\w\s.,:;%=/()µ°|+-]", " ", text).split())


def change(file: Path, diff: str, where: str) -> None:
    """Lines with `-` go, lines with `+` come, the others must stand there."""
    lines = diff.splitlines()
    old = "".join(f"{line[1:]}\n" for line in lines if line[:1] in (" ", "-") or not line)
    new = "".join(f"{line[1:]}\n" for line in lines if line[:1] in (" ", "+") or not line)
    text = file.read_text(encoding="utf-8")
    assert text.count(old) == 1, f"{where}: {file.name} does not have, once,\n{old}"
    file.write_text(text.replace(old, new), encoding="utf-8")
