"""The certificate as JSON: its statements, the page that shows it, and the signature over both."""

from __future__ import annotations

from typing import Literal

from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey

from station.certificate.facts import CertificateFacts
from station.certificate.signature import Signature, digests_of, sign
from station.messages import Language
from station.records import Record


class PrintedLine(Record):
    """One line of the page."""

    field: str
    label: str
    text: str


class Page(Record):
    """The content of one page."""

    format: Literal["html", "pdf"]
    language: Language
    lines: tuple[PrintedLine, ...]
    sha256: str
    """Hash of the page without this document."""


class CertificateDocument(Record):
    """`certificate.json`; also inside the HTML and the PDF."""

    certificate: CertificateFacts
    page: Page | None = None
    """None in `certificate.json`."""
    digests: dict[str, str]
    """Digests of every field of `certificate` and `page`."""
    signature: Signature


def signed(facts: CertificateFacts, page: Page | None, key: Ed25519PrivateKey) -> CertificateDocument:
    """All statements, with their signature."""
    digests = stated_digests(facts, page)
    return CertificateDocument(certificate=facts, page=page, digests=digests, signature=sign(key, digests))


def stated_digests(facts: CertificateFacts, page: Page | None) -> dict[str, str]:
    """The correct digests of the statements."""
    fields = facts.model_dump(mode="json")
    return digests_of(fields if page is None else {**fields, "page": page.model_dump(mode="json")})
