"""The certificate of one run: one A4 page as HTML and PDF, and JSON, with signature and verification."""

from __future__ import annotations

from station.certificate.document import CertificateDocument
from station.certificate.issuing import FORMATS, Format, Issued, issue
from station.certificate.signature import public_key_of, public_key_pem, station_key
from station.certificate.verification import Verified, verify_certificate

__all__ = [
    "FORMATS",
    "CertificateDocument",
    "Format",
    "Issued",
    "Verified",
    "issue",
    "public_key_of",
    "public_key_pem",
    "station_key",
    "verify_certificate",
]
