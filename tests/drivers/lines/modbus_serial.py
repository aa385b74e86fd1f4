"""npm's modbus-serial as a master of the emulated drives and as a slave of the station's own master.

`python -m tests.drivers.lines.modbus_serial`: the package is fetched into a separate folder.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from drivers.emulated.rig import EmulatedRig
from drivers.emulated.rig_file import parse_rig
from drivers.lines import ModbusBus
from tests.drivers.lines.libmodbus import device
from tests.drivers.lines.test_device_servers import free_port
from tests.drivers.lines.test_libmodbus import exchanges

PACKAGE = "modbus-serial@8.0.25"
EXPECTED = {"mode": 6, "position": [0, 10_000], "refused": 2}


def _as_master(script: Path, line: str) -> None:
    text = f'[machine]\nscatter = false\n[emulated]\nline = "{line}"\nbaud = 38400\n'
    with EmulatedRig(parse_rig(text), speed=500) as rig:
        where = str(device(rig.servo_url))
        said = subprocess.run(
            ["node", script, "master", where, "1"], check=True, capture_output=True, text=True, timeout=30
        )
    assert json.loads(said.stdout) == EXPECTED, said.stdout
    print(f"{PACKAGE} moves an emulated drive, {line}")


def _as_slave(script: Path) -> None:
    port = free_port()
    command = ["node", str(script), "slave", str(port)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as slave:
        assert slave.stdout is not None and slave.stdin is not None
        assert slave.stdout.readline() == "ready\n"
        exchanges(ModbusBus(f"modbus+tcp://127.0.0.1:{port}", timeout_s=0.5))
        slave.stdin.close()
    print(f"{PACKAGE} is driven, tcp")


def main() -> int:
    """0; a difference is an AssertionError."""
    with tempfile.TemporaryDirectory() as folder:
        script = Path(shutil.copy(Path(__file__).with_suffix(".js"), folder))
        subprocess.run(
            ["npm", "install", "--no-audit", "--no-fund", "--silent", PACKAGE], cwd=folder, check=True
        )
        for line in ("tcp", "rtu"):
            _as_master(script, line)
        _as_slave(script)
    return 0


if __name__ == "__main__":
    sys.exit(main())
