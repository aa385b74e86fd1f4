"""Builds the operator's page into `web/static` before the wheel is packed (editable installs included).

Node comes from PATH; only where it is missing or too old, from a wheel that pip fetches for the build alone.
"""

from __future__ import annotations

import runpy
import shutil
import subprocess
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

# not on the import path while a wheel is built
NODE = runpy.run_path(str(Path(__file__).parent / "deploy" / "node.py"))


class PageBuildHook(BuildHookInterface):  # type: ignore[type-arg]
    """`npm ci && npm run build` in `web/ui`."""

    def dependencies(self) -> list[str]:
        """What the build needs beside hatchling."""
        return [] if NODE["is_good"]() else [NODE["NODE_WHEEL"]]

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build the page."""
        npm = shutil.which("npm")
        if npm is None:
            raise RuntimeError(f"The page needs Node to be built: install it, or {NODE['NODE_WHEEL']}.")
        page = Path(self.root) / "web" / "ui"
        # the tools are development dependencies: a NODE_ENV of production must not leave them out
        subprocess.run([npm, "ci", "--include=dev"], cwd=page, check=True)
        subprocess.run([npm, "run", "build"], cwd=page, check=True)
