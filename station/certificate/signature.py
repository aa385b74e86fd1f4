"""Signature over the statements of a certificate, field by field, so that a change is reported by field name.

The digest of every field is listed, and the list is signed (Ed25519, RFC 8032) with a key that stays in the
station's home folder.  Digests and signature are made from canonical JSON (RFC 8785).
"""

from __future__ import annotations

import base64
import hashlib
import os
from collections.abc import Iterator
from pathlib import Path

import rfc8785
from cryptography.exceptions import InvalidSignature
from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey, Ed25519PublicKey
from cryptography.hazmat.primitives.serialization import (
    Encoding,
    NoEncryption,
    PrivateFormat,
    PublicFormat,
    load_pem_private_key,
    load_pem_public_key,
)
from pydantic import JsonValue

from station.errors import InputRefused
from station.records import Record

KEY_FILE = "certificate-key.pem"
_DIGEST_CHARACTERS = 32
"""128 bits: a second value with the same digest cannot be found."""


class Signature(Record):
    """Signature over the list of digests."""

    algorithm: str = "Ed25519"
    public_key: str
    """Base64 of its 32 bytes."""
    value: str
    """Base64 of 64 bytes."""


def signing_key(home: Path) -> Ed25519PrivateKey:
    """The station's own key; made with the first certificate.

    :raises InputRefused: its file cannot be read or written, or contains another kind of key.
    """
    path = home / KEY_FILE
    try:
        if not path.exists():
            _make_key(path)
        key = load_pem_private_key(path.read_bytes(), password=None)
    except OSError as error:
        raise InputRefused(
            f"The key of the certificates, {path}, cannot be used: {error.strerror}."
        ) from error
    except (ValueError, TypeError) as error:
        raise InputRefused(
            f"{path} holds no private key; restore it from a copy, or move it away for a new one."
        ) from error
    if not isinstance(key, Ed25519PrivateKey):
        raise InputRefused(f"{path} holds another kind of key; certificates are signed with Ed25519.")
    return key


def _make_key(path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    text = Ed25519PrivateKey.generate().private_bytes(Encoding.PEM, PrivateFormat.PKCS8, NoEncryption())
    # written atomically, and never over one that another process made in the meantime
    part = path.with_name(f"{path.name}.{os.getpid()}")
    with os.fdopen(os.open(part, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600), "wb") as file:
        file.write(text)
        file.flush()
        os.fsync(file.fileno())
    try:
        os.link(part, path)
    except FileExistsError:
        pass
    finally:
        part.unlink()


def public_key_pem(home: Path) -> str:
    """The public key for checking certificates."""
    key = signing_key(home).public_key()
    return key.public_bytes(Encoding.PEM, PublicFormat.SubjectPublicKeyInfo).decode()


def station_key(home: Path) -> Ed25519PublicKey | None:
    """The public key of the station at a home folder; None if it has made none.

    :raises InputRefused: as `signing_key`.
    """
    return signing_key(home).public_key() if (home / KEY_FILE).exists() else None


def public_key_of(pem: bytes, what: str) -> Ed25519PublicKey:
    """:raises InputRefused: it is not a public key of a station."""
    try:
        key = load_pem_public_key(pem)
    except ValueError as error:
        raise InputRefused(f"{what} holds no public key; `station key public` prints one.") from error
    if not isinstance(key, Ed25519PublicKey):
        raise InputRefused(f"{what} holds another kind of key; stations sign with Ed25519.")
    return key


def raw(key: Ed25519PublicKey) -> str:
    """Base64 of the 32 bytes of a public key."""
    return base64.b64encode(key.public_bytes(Encoding.Raw, PublicFormat.Raw)).decode()


def sign(key: Ed25519PrivateKey, digests: dict[str, str]) -> Signature:
    """Sign the list of digests."""
    value = key.sign(rfc8785.dumps(dict(digests)))
    return Signature(public_key=raw(key.public_key()), value=base64.b64encode(value).decode())


def holds(signature: Signature, digests: dict[str, str]) -> bool:
    """Whether the list of digests was signed with the key in the signature."""
    try:
        key = Ed25519PublicKey.from_public_bytes(base64.b64decode(signature.public_key, validate=True))
        key.verify(base64.b64decode(signature.value, validate=True), rfc8785.dumps(dict(digests)))
    except (InvalidSignature, ValueError):
        return False
    return signature.algorithm == "Ed25519"


def digests_of(fields: JsonValue) -> dict[str, str]:
    """Digests by the path of each field, as `zero_offsets[0].value`."""
    return {path: _digest(path, value) for path, value in leaves(fields)}


def leaves(value: JsonValue, path: str = "") -> Iterator[tuple[str, JsonValue]]:
    """All fields without nested fields; a list of plain values is one."""
    if isinstance(value, dict) and value:
        for name, part in value.items():
            yield from leaves(part, f"{path}.{name}" if path else name)
    elif isinstance(value, list) and any(isinstance(part, dict) for part in value):
        for index, part in enumerate(value):
            yield from leaves(part, f"{path}[{index}]")
    else:
        yield path, value


def _digest(path: str, value: JsonValue) -> str:
    return hashlib.sha256(rfc8785.dumps([path, value])).hexdigest()[:_DIGEST_CHARACTERS]
