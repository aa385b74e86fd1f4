"""Why an event was not delivered: in words, whichever layer the cause comes from."""

from __future__ import annotations

import base64
import socket
import ssl
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from datetime import UTC, datetime
from pathlib import Path

import pytest

from station.outbox.folder import Folder
from station.outbox.trouble import _SAID, in_words
from station.outbox.webhook import Webhook
from station.records import Event, uid7
from station.settings import FolderSettings, WebhookSettings
from tests.web.test_sentences import OTHERS, known_in

EVENT = Event(n=7, uid=uid7(), type="alarm", at=datetime(2026, 11, 28, tzinfo=UTC), data={"id": 3})
LIMIT_S = 10.0
CLOSED = "the connection was closed before the answer was complete"


@contextmanager
def answering(answer: bytes) -> Iterator[str]:
    """A receiver that reads a request, answers with these bytes and closes; its address."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        server.settimeout(LIMIT_S)

        def serve() -> None:
            with suppress(TimeoutError):
                connection, _ = server.accept()
                with connection:
                    connection.recv(65536)
                    connection.sendall(answer)

        thread = threading.Thread(target=serve)
        thread.start()
        yield f"http://127.0.0.1:{server.getsockname()[1]}/hook"
        thread.join()


def said_of(url: str, folder: Path) -> str:
    secret = folder / "secret"
    secret.write_text("whsec_" + base64.b64encode(bytes(32)).decode())
    receiver = Webhook(WebhookSettings(url=url, secret_file=secret))
    with pytest.raises(Exception) as failure:
        receiver.deliver(EVENT)
    return in_words(failure.value)


def test_a_port_where_nobody_listens(tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
    assert said_of(f"http://127.0.0.1:{port}/hook", tmp_path) == "nothing accepts connections there"


@pytest.mark.parametrize(
    ("answer", "said"),
    [
        (b"", CLOSED),
        (b"HTTP/1.1 200 OK\r\nContent-Length: 9\r\n\r\nhal", CLOSED),
        (b"HTTP/1.1 500 Busy\r\nContent-Length: 0\r\n\r\n", "answered 500 Busy"),
    ],
)
def test_what_a_receiver_answers(tmp_path: Path, answer: bytes, said: str) -> None:
    with answering(answer) as url:
        assert said_of(url, tmp_path) == said


def test_a_folder_that_is_a_file(tmp_path: Path) -> None:
    (tmp_path / "out").write_text("in the way")
    with pytest.raises(OSError) as failure:
        Folder(FolderSettings(path=tmp_path / "out", format="json")).deliver(EVENT)
    assert in_words(failure.value) == "the folder is a file"


@pytest.mark.parametrize(
    ("error", "said"),
    [
        (TimeoutError("timed out"), "no answer within the time limit"),
        (TimeoutError(110, "Connection timed out"), "no answer within the time limit"),
        (socket.gaierror(-2, "Name or service not known"), "no computer of that name is known"),
        (OSError(28, "No space left on device"), "the disk is full"),
        (PermissionError(13, "Permission denied"), "the station may not write there"),
        (ssl.SSLError(1, "WRONG_VERSION_NUMBER"), "no encrypted connection could be made"),
    ],
)
def test_a_cause_is_found_below_other_errors(error: Exception, said: str) -> None:
    try:
        raise RuntimeError("of a library") from error
    except RuntimeError as above:
        assert in_words(error) == in_words(above) == said


def test_another_error_says_its_own_text() -> None:
    assert in_words(TimeoutError("the broker did not acknowledge")) == "the broker did not acknowledge"
    assert (in_words(OSError("answered 503")), in_words(ValueError())) == ("answered 503", "ValueError")


@pytest.mark.parametrize("language", OTHERS)
def test_each_cause_is_translated(language: str) -> None:
    texts = {*_SAID.values(), "no encrypted connection could be made", "its certificate is not accepted: {}"}
    assert texts <= known_in(language)
