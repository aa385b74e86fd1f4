"""Nothing passes outside the dates of the scale's certificate, and each run says what made it."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest

from station import __version__
from station.errors import InputRefused
from station.records import MadeBy, State
from station.service.traceability import traced
from station.settings import ScaleCertificateSettings, Settings, load_settings
from station.store.store import Store
from tests.station.asking import asked, result
from tests.station.conftest import SETTINGS, Start
from tests.station.service.test_orchestrator import LIMIT_S

TODAY = datetime.now(UTC).date()
DAY = timedelta(days=1)


def certificate(first: timedelta, last: timedelta) -> ScaleCertificateSettings:
    return ScaleCertificateSettings(
        scale="SN 4711", certificate="D-K 12", laboratory="Lab", calibrated=TODAY + first, due=TODAY + last,
        u95_um=1.0,
    )  # fmt: skip


def made_by(settings: ScaleCertificateSettings | None) -> MadeBy:
    return MadeBy(station="S", software="1", libraries={}, emulated=False, scale_certificate=settings)


@pytest.mark.parametrize(
    ("first", "last", "passes"),
    [(-DAY, DAY, True), (0 * DAY, 0 * DAY, True), (-9 * DAY, -DAY, False), (DAY, 9 * DAY, False)],
)
def test_a_pass_needs_a_certificate_that_covers_the_day(
    first: timedelta, last: timedelta, passes: bool
) -> None:
    found = traced(result(), made_by(certificate(first, last)), TODAY)
    assert (found.verdict == "pass", found.outcome) == (passes, "good" if passes else "not_verified")
    assert passes or "D-K 12" in found.reason.text


def test_without_a_certificate_and_without_a_pass_nothing_changes() -> None:
    assert traced(result(), made_by(None), TODAY) == traced(result(), None, TODAY) == result()
    failed = result(verdict="fail", outcome="repair")
    assert traced(failed, made_by(certificate(-9 * DAY, -DAY)), TODAY) == failed


def test_a_run_on_a_scale_past_its_date_is_no_pass_and_says_what_made_it(start: Start, store: Store) -> None:
    settings = SETTINGS.model_copy(update={"scale_certificate": certificate(-9 * DAY, -DAY)})
    orchestrator = start(settings=settings)
    run = orchestrator.submit(asked("FB-1", "paper")).id
    assert orchestrator.wait(run, LIMIT_S) is State.SUCCEEDED
    kept = store.calibration(run)
    assert (kept.verdict, kept.outcome, kept.reason_code) == ("fail", "not_verified", "scale_not_covered")
    found = store.made_by(run)
    assert found is not None and found.scale_certificate is not None
    assert (found.software, found.scale_certificate.scale) == (__version__, "SN 4711")
    assert [point.software for point in store.trend(limit=9)] == [__version__]
    assert found.libraries.keys() == {"python", "numpy", "scipy"}
    assert [device.name for device in found.devices] == ["scale", "axis 1", "axis 2"]
    assert store.verify().broken is None


def test_a_section_with_a_wrong_date_is_refused_by_name(tmp_path: Path) -> None:
    path = tmp_path / "station.toml"
    path.write_text('[scale_certificate]\nscale = "S"\ncertificate = "C"\nlaboratory = "L"\ndue = "soon"\n')
    with pytest.raises(InputRefused, match="scale_certificate"):
        load_settings(path)
    assert Settings().scale_certificate is None
