"""A separate `station serve` process that can be killed and restarted at its address."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path
from urllib.parse import urlsplit

ROOT = Path(__file__).parents[1]
END_LIMIT_S = 15.0


class Served:
    """A station on the emulated rig, in a separate folder; `with` starts it."""

    def __init__(self, home: Path, toml: str) -> None:
        """:param toml: text of the station file"""
        self.home, self.port = home, 0
        self.config = home / "station.toml"
        self.config.write_text(toml)
        self._process: subprocess.Popen[str] | None = None

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self.port}"

    def __enter__(self) -> Served:
        self.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.end()

    def start(self) -> None:
        """Start it; returns when it listens, at its earlier port."""
        command = [sys.executable, "-m", "station", "--home", str(self.home), "serve"]
        self._process = subprocess.Popen(
            [*command, "--config", str(self.config), "--port", str(self.port)],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            cwd=ROOT,
            start_new_session=True,
        )
        assert self._process.stdout is not None
        said = self._process.stdout.readline()
        found = re.search(r"http://\S+", said)
        assert found, f"the station did not start: {said}"
        self.port = urlsplit(found[0]).port or 0

    def kill(self) -> None:
        """Kill it, as a power failure does."""
        assert self._process is not None
        self._process.kill()
        self.end()

    def end(self) -> None:
        """Ask it to end, and wait until it has."""
        process, self._process = self._process, None
        if process is None:
            return
        process.terminate()
        process.wait(END_LIMIT_S)
        assert process.stdout is not None
        process.stdout.close()
