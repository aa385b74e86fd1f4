"""In the clean tree: bring loopback up (`up`), or start a station, fetch its page and ask its doctor."""

from __future__ import annotations

import fcntl
import socket
import struct
import subprocess
import sys
import time
import urllib.request

PORT = 8000
STARTS_WITHIN_S = 60.0
SIOCSIFFLAGS, IFF_UP = 0x8914, 1


def loopback_up() -> None:
    """As `ip link set lo up`, which a minimal Debian does not have."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as control:
        fcntl.ioctl(control, SIOCSIFFLAGS, struct.pack("16sh14x", b"lo", IFF_UP))


def page() -> str:
    """The page of the station, once it answers.  :raises OSError: it does not."""
    until = time.monotonic() + STARTS_WITHIN_S
    while True:
        try:
            with urllib.request.urlopen(f"http://127.0.0.1:{PORT}/", timeout=5) as answer:
                return str(answer.read(), "utf-8")
        except OSError:
            if time.monotonic() > until:
                raise
            time.sleep(0.5)


def main(station: str) -> int:
    """0: it serves its page with the script that belongs to it, and its doctor finds nothing."""
    service = subprocess.Popen([station, "serve", "--port", str(PORT)])
    try:
        content = page()
    finally:
        service.terminate()
        service.wait(30)
    script = 'src="/assets/' in content
    print("The page is served." if script else f"The page has no script:\n{content}")
    doctor = subprocess.run([station, "doctor"], check=False)
    return 0 if script and doctor.returncode == 0 else 1


if __name__ == "__main__":
    if sys.argv[1] == "up":
        loopback_up()
    else:
        sys.exit(main(sys.argv[1]))
