"""Whether a certificate is as the station issued it, and the changed fields by name."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from dataclasses import dataclass
from html.parser import HTMLParser
from pathlib import Path

from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PublicKey
from pydantic import JsonValue, ValidationError

from station.certificate.document import CertificateDocument, Page
from station.certificate.html import html_sha256, split_document
from station.certificate.signature import digests_of, holds, leaves, raw
from station.errors import InputRefused, NotFound
from station.records import content_of
from station.store import Store, link_hash


@dataclass(frozen=True, slots=True)
class Verified:
    """The result of a verification."""

    number: str
    run: int
    faults: tuple[str, ...]
    """One sentence for each fault; empty: nothing was changed."""
    by: str
    """The reference for the verification."""

    @property
    def holds(self) -> bool:
        """Whether nothing was changed."""
        return not self.faults


def verify_certificate(path: Path, store: Store | None, key: Ed25519PublicKey | None) -> Verified:
    """Check a certificate against the station's history, or its public key if there is no history.

    :raises InputRefused: the file is not a certificate, or there is neither history nor key.
    """
    if store is None and key is None:
        raise InputRefused(
            "A certificate is checked against the history of its station (--home) or against its public key"
            " (--key FILE, from `station key public`); there is neither."
        )
    content = content_of(path)
    form, text, page_text = _opened(content, path)
    fields = _fields(text, path)
    document = _document(fields, path)
    faults = [*_changed(fields, document), *_signed(document, key)]
    if document.page is not None or form != "json":
        faults += _page_changed(form, content, page_text, document.page)
    faults += _chain_broken(document)
    if store is not None:
        faults += _not_as_kept(store, document)
    by = " and ".join(
        name
        for name, known in (("the station's history", store), ("its public key", key))
        if known is not None
    )
    return Verified(document.certificate.number, document.certificate.run, tuple(dict.fromkeys(faults)), by)


def _opened(content: bytes, path: Path) -> tuple[str, str, str]:
    """Format, the document inside, and the page around it (HTML)."""
    if content.startswith(b"%PDF"):
        from station.certificate import pdf  # imported here, as in `issuing`

        try:
            documents = pdf.attached(content)
        except ValueError as error:
            raise InputRefused(f"{path} is a damaged PDF; ask for it again.") from error
        if len(documents) != 1:
            raise InputRefused(
                f"{path} has no {pdf.ATTACHMENT} inside; it is not a certificate of a station."
            )
        return "pdf", documents[0].decode("utf-8", "replace"), ""
    try:
        text = content.decode("utf-8")
    except UnicodeDecodeError as error:
        raise InputRefused(f"{path} is neither JSON nor HTML nor PDF.") from error
    if not text.lstrip().startswith("<"):
        return "json", text, ""
    if (parts := split_document(text)) is None:
        raise InputRefused(f"{path} holds no signed certificate; it is not one of a station.")
    page, document = parts
    return "html", document, page


def _fields(text: str, path: Path) -> dict[str, JsonValue]:
    try:
        fields = json.loads(text)
    except ValueError as error:
        raise InputRefused(f"{path} is not whole: the certificate inside is no JSON ({error}).") from error
    if not isinstance(fields, dict):
        raise InputRefused(f"{path} is not a certificate of a station.")
    return fields


def _document(fields: dict[str, JsonValue], path: Path) -> CertificateDocument:
    try:
        return CertificateDocument.model_validate(fields)
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(str(part) for part in first["loc"])
        raise InputRefused(f"{path} is not a certificate of a station: {where} is wrong.") from error


def _changed(fields: dict[str, JsonValue], document: CertificateDocument) -> Iterator[str]:
    """Changed fields, compared as text in the file: 1.0 and 1.00 have the same meaning but differ here."""
    stated = fields.get("certificate")
    assert isinstance(stated, dict)
    page = fields.get("page")
    found = digests_of(stated if page is None else {**stated, "page": page})
    for name in document.digests.keys() | found.keys():
        if name not in found:
            yield f"{name} is missing."
        elif name not in document.digests:
            yield f"{name} was added."
        elif found[name] != document.digests[name]:
            yield f"{name} was changed."


def _signed(document: CertificateDocument, key: Ed25519PublicKey | None) -> Iterator[str]:
    if not holds(document.signature, document.digests):
        yield "signature does not hold: it, or the list of digests, was changed."
    elif key is not None and document.signature.public_key != raw(key):
        yield "signature.public_key is that of another station: this one did not sign it."


def _page_changed(form: str, content: bytes, page_text: str, page: Page | None) -> Iterator[str]:
    """The differences of the readable text from the signed one."""
    if page is None or page.format != form:
        yield f"page is not that of {form.upper()}: the document inside belongs to another file."
        return
    if form == "html":
        if html_sha256(page_text) == page.sha256:
            return
        shown = _shown_html(page_text)
    else:
        from station.certificate import pdf

        if pdf.content_sha256(content) == page.sha256:
            return
        shown = {"": _bare(pdf.shown_text(content))}
    names = [
        line.field for line in page.lines if _bare(line.text) not in shown.get(line.field, shown.get("", ""))
    ]
    if names:
        yield from (f"The page shows another {name} than was signed." for name in names)
    else:
        yield "The page was changed beside its fields."


def _shown_html(text: str) -> dict[str, str]:
    reader = _Fields()
    reader.feed(text)
    return {field: _bare(shown) for field, shown in reader.shown.items()}


class _Fields(HTMLParser):
    """Text by the `data-field` of its element."""

    def __init__(self) -> None:
        super().__init__()
        self.shown: dict[str, str] = {}
        self._field = ""

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if field := dict(attrs).get("data-field"):
            self._field = field
            self.shown[field] = ""

    def handle_endtag(self, tag: str) -> None:
        if tag in ("dd", "p"):
            self._field = ""

    def handle_data(self, data: str) -> None:
        if self._field:
            self.shown[self._field] += data


def _bare(text: str) -> str:
    """The text without blanks, where a page may break lines."""
    return re.sub(r"\s", "", text)


def _chain_broken(document: CertificateDocument) -> Iterator[str]:
    record = document.certificate.record
    if record is not None and link_hash(record.previous, record.fields) != record.hash:
        yield "record.hash is not that of the record."


def _not_as_kept(store: Store, document: CertificateDocument) -> Iterator[str]:
    facts = document.certificate
    try:
        kept_uid = store.summary(facts.run).uid
    except NotFound:
        kept_uid = ""
    if kept_uid != facts.number:
        yield f"number: the history has no run {facts.run} with the number {facts.number}."
        return
    kept = store.chained(facts.run)
    if facts.record is None or kept is None:
        if (facts.record is None) != (kept is None):
            yield "record is not as the history has it."
        return
    ours, theirs = dict(leaves(facts.record.fields)), dict(leaves(kept.record))
    for name in ours.keys() | theirs.keys():
        if ours.get(name) != theirs.get(name):
            yield f"record.fields.{name} is not as the history has it."
    if (facts.record.previous, facts.record.hash) != (kept.previous, kept.hash):
        yield "record.hash is not that in the history."
