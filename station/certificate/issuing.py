"""A certificate in the requested format."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Literal, get_args

from station.certificate.document import CertificateDocument, Page, PrintedLine, signed
from station.certificate.facts import facts_of
from station.certificate.html import html_page, html_sha256, with_document
from station.certificate.sheet import Sheet, sheet_of
from station.certificate.signature import signing_key
from station.messages import Language
from station.settings import JointSettings
from station.store import Store

Format = Literal["html", "pdf", "json"]
FORMATS: tuple[Format, ...] = get_args(Format)
MEDIA_TYPES: dict[Format, str] = {
    "html": "text/html; charset=utf-8",
    "pdf": "application/pdf",
    "json": "application/json",
}


@dataclass(frozen=True, slots=True)
class Issued:
    """One file."""

    content: bytes
    media_type: str
    name: str


def issue(
    store: Store,
    run: int,
    form: Format,
    *,
    home: Path,
    joints: Sequence[JointSettings],
    language: Language = "en",
) -> Issued:
    """The certificate of a run, generated from its record and signed.

    :param joints: range of the commands of each joint, for the map
    :raises NotFound: no such run.
    :raises NotApplicable: there is nothing to certify; the error states why.
    :raises InputRefused: the station's key cannot be used.
    """
    facts = facts_of(store, run, datetime.now(UTC).replace(microsecond=0), joints)
    key = signing_key(home)
    if form == "json":
        content = _json(signed(facts, None, key))
    else:
        sheet = sheet_of(facts, language)
        if form == "html":
            bare = html_page(sheet, facts)
            page = _page("html", sheet, html_sha256(bare))
            content = with_document(bare, _json(signed(facts, page, key)).decode()).encode()
        else:
            # imported here, because libraries for PDF take a second to load and only this needs them
            from station.certificate.pdf import content_sha256, pdf_page, with_attachment

            printed = pdf_page(sheet, facts)
            page = _page("pdf", sheet, content_sha256(printed))
            content = with_attachment(printed, _json(signed(facts, page, key)))
    return Issued(content, MEDIA_TYPES[form], f"certificate-{run}.{form}")


def _page(form: Literal["html", "pdf"], sheet: Sheet, sha256: str) -> Page:
    lines = tuple(PrintedLine(field=line.field, label=line.label, text=line.text) for line in sheet.lines)
    return Page(format=form, language=sheet.language, lines=lines, sha256=sha256)


def _json(document: CertificateDocument) -> bytes:
    return document.model_dump_json(indent=1).encode()
