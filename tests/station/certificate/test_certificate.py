"""What a certificate states is what is on record, and one changed digit is found by the name of its field."""

from __future__ import annotations

import json
import random
import re
from io import BytesIO
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result
from pypdf import PdfReader, PdfWriter
from pypdf.generic import NameObject, StreamObject

from station.certificate import FORMATS, Format, issue, pdf
from station.certificate.signature import leaves
from station.cli import main
from station.errors import InputRefused
from station.messages import LANGUAGES, Language
from station.settings import Settings
from station.store import Store

JOINTS = Settings().joints


def issued(store: Store, home: Path, form: Format, language: Language = "en") -> bytes:
    return issue(store, 1, form, home=home, joints=JOINTS, language=language).content


def verify(file: Path, home: Path, *more: str) -> Result:
    return CliRunner().invoke(main, ["--home", str(home), "verify-certificate", str(file), *more])


def written(folder: Path, form: str, content: bytes) -> Path:
    file = folder / f"certificate.{form}"
    file.write_bytes(content)
    return file


@pytest.mark.parametrize("form", FORMATS)
@pytest.mark.parametrize("language", LANGUAGES)
def test_as_it_was_issued_it_is_valid(kept: Store, home: Path, form: Format, language: Language) -> None:
    found = verify(written(home, form, issued(kept, home, form, language)), home)
    assert (found.exit_code, found.output.split(":")[0]) == (0, "Valid"), found.output


def test_its_numbers_are_those_of_the_record(kept: Store, home: Path) -> None:
    facts = json.loads(issued(kept, home, "json"))["certificate"]
    run = kept.calibration(1)
    assert [zero["value"] for zero in facts["zero_offsets"]] == [z.value_deg for z in run.zero_offsets]
    assert [zero["u95"] for zero in facts["zero_offsets"]] == [2 * (z.sd_deg or 0) for z in run.zero_offsets]
    assert run.accuracy is not None
    assert facts["position_error"]["bound_95_mm"] == run.accuracy.bound_95_mm
    assert facts["record"]["hash"] == kept.verify().head
    assert (facts["number"], facts["robot_serial"], facts["operator"]) == (run.uid, "EXAMPLE", "Ana")


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_page_is_one_and_says_the_numbers_in_the_readers_language(
    kept: Store, home: Path, language: Language
) -> None:
    pages = PdfReader(BytesIO(issued(kept, home, "pdf", language))).pages
    assert len(pages) == 1
    bound = kept.calibration(1).accuracy
    assert bound is not None and bound.bound_95_mm is not None
    text = f"{bound.bound_95_mm:.3f}"
    said = text.replace(".", ",") if language == "de" else text
    assert f"{said}mm" in re.sub(r"\s", "", pages[0].extract_text())
    assert said in issued(kept, home, "html", language).decode()


@pytest.mark.skipif(not pdf.CHINESE_FONTS[0].is_file(), reason="deploy/debian-packages fonts-wqy-microhei")
def test_a_chinese_page_brings_its_glyphs_where_the_font_is_installed(
    kept: Store, home: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A reader without Chinese fonts showed nothing but digits."""

    def drawn_with() -> dict[str, bool]:
        page: Any = PdfReader(BytesIO(issued(kept, home, "pdf", "zh"))).pages[0]
        fonts = [font.get_object() for font in page["/Resources"]["/Font"].values()]
        used = [font for font in fonts if font["/BaseFont"] != "/Helvetica"]
        return {font["/BaseFont"]: "/FontFile2" in font.get("/FontDescriptor", {}) for font in used}

    embedded = drawn_with()
    assert embedded and all(embedded.values())
    assert len(issued(kept, home, "pdf", "zh")) < 300_000
    monkeypatch.setattr(pdf, "CHINESE_FONTS", ())
    assert drawn_with() == {"/STSong-Light": False}


def digits_of(value: Any, path: str = "") -> list[str]:
    """Paths of all fields with a digit, but those of hashes and keys."""
    return [name for name, leaf in leaves(value, path) if re.search(r"\d", json.dumps(leaf))]


def with_one_digit_changed(document: dict[str, Any], path: str) -> dict[str, Any]:
    changed: dict[str, Any] = json.loads(json.dumps(document))
    part: Any = changed["certificate"]
    *inside, last = re.findall(r"[^.\[\]]+", path)
    for step in inside:
        part = part[int(step) if isinstance(part, list) else step]
    key = int(last) if isinstance(part, list) else last
    text = json.dumps(part[key])
    at = re.search(r"[0-9](?![^\"]*T\d)", text) or re.search(r"\d", text)
    assert at is not None
    digit = "1" if at[0] in "02" else "2"
    part[key] = json.loads(text[: at.start()] + digit + text[at.end() :])
    return changed


def test_one_changed_digit_is_refused_by_the_name_of_the_field(kept: Store, home: Path) -> None:
    document = json.loads(issued(kept, home, "json"))
    (home / "public.pem").write_text(CliRunner().invoke(main, ["--home", str(home), "key", "public"]).output)
    paths = digits_of(document["certificate"])
    assert len(paths) > 300
    always = [
        "zero_offsets[0].value",
        "zero_offsets[1].u95",
        "position_error.bound_95_mm",
        "record.hash",
        "run",
    ]
    for path in [*always, *random.Random(17).sample(paths, 25)]:
        changed = written(home, "json", json.dumps(with_one_digit_changed(document, path)).encode())
        for checked in (
            verify(changed, home),
            verify(changed, home / "else", "--key", str(home / "public.pem")),
        ):
            assert checked.exit_code != 0, path
            assert path in checked.output, checked.output


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_digit_changed_on_the_html_page_is_named(kept: Store, home: Path, language: Language) -> None:
    page = issued(kept, home, "html", language).decode()
    changed = re.sub(r'(data-field="zero_offsets\[0\]">)1', r"\g<1>7", page)
    assert changed != page
    found = verify(written(home, "html", changed.encode()), home)
    assert found.exit_code == 1
    assert "zero_offsets[0]" in found.output and "zero_offsets[1]" not in found.output


def test_anything_else_changed_on_the_html_page_is_found(kept: Store, home: Path) -> None:
    page = issued(kept, home, "html").decode()
    for old, new in (("<h1>Calibration", "<h1>Excellent calibration"), ("#fde725", "#440154")):
        found = verify(written(home, "html", page.replace(old, new).encode()), home)
        assert (found.exit_code, "The page was changed" in found.output) == (1, True)


def redrawn(pdf: bytes, change: Any) -> bytes:
    """The same file with another page content."""
    writer = PdfWriter(clone_from=BytesIO(pdf))
    page = writer.pages[0]
    contents = page.get_contents()
    assert contents is not None
    stream = StreamObject()
    stream.set_data(change(contents.get_data()))
    page[NameObject("/Contents")] = writer._add_object(stream)
    out = BytesIO()
    writer.write(out)
    return out.getvalue()


def test_a_redrawn_pdf_is_refused(kept: Store, home: Path) -> None:
    pdf = issued(kept, home, "pdf")
    assert verify(written(home, "pdf", redrawn(pdf, lambda data: data)), home).exit_code == 0
    emptied = verify(written(home, "pdf", redrawn(pdf, lambda data: b"")), home)
    assert emptied.exit_code == 1 and "another zero_offsets[0]" in emptied.output
    added = verify(written(home, "pdf", redrawn(pdf, lambda data: data + b"\n0 0 9 9 re f")), home)
    assert added.exit_code == 1 and "changed beside its fields" in added.output


def test_a_certificate_signed_by_somebody_else_is_refused(kept: Store, home: Path, tmp_path: Path) -> None:
    theirs = issued(kept, tmp_path / "elsewhere", "json")
    issued(kept, home, "json")
    found = verify(written(home, "json", theirs), home)
    assert (found.exit_code, "another station" in found.output) == (1, True)


def test_a_record_that_was_changed_in_the_history_is_named_and_not_certified(kept: Store, home: Path) -> None:
    file = written(home, "json", issued(kept, home, "json"))
    kept._writer.execute("UPDATE calibrations SET operator = 'Eve' WHERE id = 1")
    found = verify(file, home)
    assert (found.exit_code, "record.fields.operator" in found.output) == (1, True)
    refused = CliRunner().invoke(main, ["--home", str(home), "certificate", "1", str(home / "new.pdf")])
    assert (refused.exit_code, "not as it ended" in refused.output) == (2, True)
    assert not (home / "new.pdf").exists()


def test_a_file_that_is_none_or_a_check_against_nothing_is_refused_in_one_sentence(
    kept: Store, home: Path
) -> None:
    good = issued(kept, home, "json")
    assert "there is neither" in verify(written(home, "json", good), home / "empty").output
    whole = issued(kept, home, "pdf")
    for form, content in (
        ("json", b"{}"), ("json", b"[1]"), ("json", good[:-9]), ("json", b"\xff\xfe"),
        ("html", b"<html></html>"), ("pdf", whole[:900]), ("pdf", b"%PDF-1.4"),
    ):  # fmt: skip
        found = verify(written(home, form, content), home)
        assert (found.exit_code, found.output.count("\n")) == (2, 1), (content[:20], found.output)
    assert verify(home / "missing.pdf", home).exit_code == 2


def test_the_key_is_made_once_for_its_owner_alone(kept: Store, home: Path) -> None:
    public = [CliRunner().invoke(main, ["--home", str(home), "key", "public"]).output for _ in range(2)]
    assert public[0] == public[1] and public[0].startswith("-----BEGIN PUBLIC KEY-----")
    key = home / "certificate-key.pem"
    assert key.stat().st_mode & 0o777 == 0o600
    assert [path.name for path in home.glob("certificate-key*")] == ["certificate-key.pem"]
    key.write_text("no key")
    with pytest.raises(InputRefused, match="holds no private key"):
        issued(kept, home, "json")
