"""Why an event could not be delivered, in words for a person."""

from __future__ import annotations

import errno
import socket
from collections.abc import Iterator
from ssl import SSLCertVerificationError, SSLError

_CLOSED = "the connection was closed before the answer was complete"
_SAID = {
    errno.ECONNREFUSED: "nothing accepts connections there",
    errno.ECONNRESET: _CLOSED,
    errno.EPIPE: _CLOSED,
    errno.EHOSTUNREACH: "there is no way to that computer in the network",
    errno.ENETUNREACH: "there is no way to that computer in the network",
    errno.ENOSPC: "the disk is full",
    errno.EDQUOT: "the disk is full",
    errno.EACCES: "the station may not write there",
    errno.EPERM: "the station may not write there",
    errno.EROFS: "the station may not write there",
    errno.ENOTDIR: "the folder is a file",
    errno.EEXIST: "the folder is a file",
}


def in_words(error: BaseException) -> str:
    """The first known cause of an error; otherwise its own text."""
    for cause in _causes(error):
        match cause:
            case SSLCertVerificationError():
                return f"its certificate is not accepted: {cause.verify_message}"
            case SSLError():
                return "no encrypted connection could be made"
            case socket.gaierror():
                return "no computer of that name is known"
            case OSError() if cause.errno in _SAID:
                return _SAID[cause.errno]
            case TimeoutError() if not cause.args or cause.errno or "timed out" in str(cause):
                return "no answer within the time limit"
    if type(error).__name__ == "RemoteProtocolError":  # of the HTTP client, which is not loaded here
        return _CLOSED
    return str(error) or type(error).__name__


def _causes(error: BaseException) -> Iterator[BaseException]:
    cause: BaseException | None = error
    while cause is not None:
        yield cause
        cause = cause.__cause__ or cause.__context__
