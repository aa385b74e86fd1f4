"""JSON as in RFC 8259: no NaN, no numbers beyond a double, no invalid text."""

from __future__ import annotations

import json
import math
import re
from typing import Any

from fastapi import Request
from fastapi.exceptions import RequestValidationError
from starlette.exceptions import HTTPException

_NOT_TEXT = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f\ud800-\udfff]")
"""Control characters except tab and line ends, and halves of UTF-16 pairs."""
DEEPEST = 64
LARGEST = 1_000_000
"""Maximum bytes of a body; files have a separate limit (`web.uploads`)."""


class StrictRequest(Request):
    """A request whose JSON contains only values that can be stored and sent, with a size limit."""

    async def body(self) -> bytes:
        """:raises HTTPException: it is too large; the remainder is not read."""
        if not hasattr(self, "_body"):
            content = bytearray()
            async for chunk in self.stream():
                content += chunk
                if len(content) > LARGEST:
                    raise HTTPException(413, f"The body is larger than {LARGEST} bytes.")
            self._body = bytes(content)
        return self._body

    async def json(self) -> Any:
        """:raises RequestValidationError: it is not JSON; the error names the location."""
        if not hasattr(self, "_json"):
            body = await self.body()
            self._json = parse(body) if body else None
        return self._json


def is_json(content_type: str) -> bool:
    """Whether a body of this type is JSON."""
    kind = content_type.partition(";")[0].strip().lower()
    return kind == "application/json" or (kind.startswith("application/") and kind.endswith("+json"))


def parse(body: bytes) -> Any:
    """:raises RequestValidationError:"""
    try:
        value = json.loads(
            body.decode("utf-8"), parse_constant=_no_number, parse_float=_finite, parse_int=_int
        )
    except json.JSONDecodeError as error:
        raise _refused((error.pos,), f"is not JSON: {error.msg}") from error
    except UnicodeDecodeError as error:
        raise _refused((error.start,), "is not JSON: it is not UTF-8") from error
    except RecursionError as error:
        raise _refused((), f"is nested deeper than {DEEPEST} levels") from error
    except ValueError as error:
        raise _refused((), str(error)) from error
    _check(value, ())
    return value


def _check(value: Any, where: tuple[str | int, ...]) -> None:
    if len(where) > DEEPEST:
        raise _refused(where[:3], f"is nested deeper than {DEEPEST} levels")
    if isinstance(value, str) and _NOT_TEXT.search(value):
        raise _refused(where, "holds control characters or halves of characters")
    if isinstance(value, dict):
        for key, part in value.items():
            if _NOT_TEXT.search(key):
                raise _refused(where, "has a name with control characters or halves of characters")
            _check(part, (*where, key))
    elif isinstance(value, list):
        for index, part in enumerate(value):
            _check(part, (*where, index))


def _no_number(text: str) -> Any:
    raise ValueError(f"{text} is no number in JSON")


def _finite(text: str) -> float:
    number = float(text)
    if not math.isfinite(number):
        raise ValueError(f"{text[:20]} is beyond every number")
    return number


def _int(text: str) -> int:
    if len(text) > 20:
        raise ValueError(f"{text[:20]}... has too many digits")
    return int(text)


def _refused(where: tuple[str | int, ...], text: str) -> RequestValidationError:
    return RequestValidationError(
        [{"type": "json_invalid", "loc": ("body", *where), "msg": text, "input": None}]
    )
