"""`station serve`: the page and the REST interface, until the process is told to end."""

from __future__ import annotations

import logging
import signal
import socket
from pathlib import Path
from threading import Thread
from types import FrameType

import click
import uvicorn

from station.cli.kept import new_history
from station.cli.machine_options import Machine, logging_to, machine_options
from station.errors import InputRefused
from station.service import Orchestrator, Runtime, check_entrance
from station.settings import database_path
from web.app import access_of, create_app

_GRACE_S = 3


@click.command("serve")
@click.option("--host", help="Address to listen on.  [default: that of the station file, else 127.0.0.1]")
@click.option(
    "--port",
    type=click.IntRange(0, 65535),
    help="Port to listen on; 0: any free port.  [default: that of the station file, else 8000]",
)
@machine_options
@click.pass_obj
def serve_command(
    home: Path,
    host: str | None,
    port: int | None,
    machine: Machine,
) -> None:
    """Start the service with the operator's page."""
    settings = machine.settings
    new = new_history(database_path(settings, home))
    logs = logging_to(home, terminal=logging.WARNING)
    host = host or settings.service.host
    emulated = machine.emulate is not None or settings.scale is None
    if settings.openid is None:  # with a provider somebody can always sign in
        check_entrance(database_path(settings, home), host, emulated=emulated)
    listener = _listen(host, settings.service.port if port is None else port)
    with logs, listener, Runtime.open(settings, home, machine.emulate) as runtime:
        if new:
            click.echo(new, err=True)
        access = access_of(runtime, host)
        application = create_app(runtime, access=access)
        server = _Server(
            uvicorn.Config(
                application,
                log_config=None,
                access_log=False,
                timeout_graceful_shutdown=_GRACE_S,
                proxy_headers=False,  # web.borders believes declared proxies alone
                server_header=False,
            ),
            runtime.orchestrator,
            access.offer_first_administrator(),
        )
        # uvicorn raises a signal again once it has ended; by then it has been obeyed.
        for ending in (signal.SIGINT, signal.SIGTERM):
            signal.signal(ending, signal.SIG_IGN)
        signal.signal(signal.SIGHUP, server.handle_exit)
        server.run(sockets=[listener])


def _listen(host: str, port: int) -> socket.socket:
    """:raises InputRefused: the address is taken or not this computer's."""
    try:
        family, kind, protocol, _, address = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0]
        # The protocol is named because asyncio otherwise leaves Nagle's delay on: 40 ms per answer.
        listener = socket.socket(family, kind, protocol)
    except OSError as error:
        raise InputRefused(f"Cannot listen on {host}:{port}: {error.strerror}.") from error
    try:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind(address)
        listener.listen()
    except OSError as error:
        listener.close()
        raise InputRefused(f"Cannot listen on {host}:{port}: {error.strerror}.") from error
    return listener


class _Server(uvicorn.Server):
    """Says when it listens, and stops the machine the moment it is told to end."""

    def __init__(self, config: uvicorn.Config, orchestrator: Orchestrator, first: str | None) -> None:
        """
        :param first: secret of the link that makes the first administrator; None where there is one
        """
        super().__init__(config)
        self._orchestrator, self._first = orchestrator, first

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        for listener in sockets or ():
            host, port = listener.getsockname()[:2]
            click.echo(f"Station ready: http://{host}:{port}")
            if self._first is not None:
                click.echo(
                    "Nobody can sign in as administrator yet; this link makes the first, once:"
                    f" http://{host}:{port}/sign-in#first={self._first}"
                )

    def handle_exit(self, sig: int, frame: FrameType | None) -> None:
        # Not here: a signal handler may have interrupted somebody who holds the locks this needs.
        Thread(target=self._orchestrator.shutdown, name="shutdown").start()
        super().handle_exit(sig, frame)
