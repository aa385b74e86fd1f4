"""The certificate as JSON: what it states, the page that shows it, and the signature over both."""

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
    """What one page shows."""

    format: Literal["html", "pdf"]
    language: Language
    lines: tuple[PrintedLine, ...]
    sha256: str
    """Of the page without this document."""


class CertificateDocument(Record):
    """`certificate.json`; also inside the HTML and the PDF."""

    certificate: CertificateFacts
    page: Page | None = None
    """None in `certificate.json`."""
    digests: dict[str, str]
    """Of every field of `certificate` and `page`."""
    signature: Signature


def signed(facts: CertificateFacts, page: Page | None, key: Ed25519PrivateKey) -> CertificateDocument:
    """Everything that is stated, with its signature."""
    digests = stated_digests(facts, page)
    return CertificateDocument(certificate=facts, page=page, digests=digests, signature=sign(key, digests))


def stated_digests(facts: CertificateFacts, page: Page | None) -> dict[str, str]:
    """As they have to be."""
    fields = facts.model_dump(mode="json")
    return digests_of(fields if page is None else {**fields, "page": page.model_dump(mode="json")})
