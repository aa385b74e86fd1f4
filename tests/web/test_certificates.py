"""Certificates over REST."""

from __future__ import annotations

import json

from tests.web.conftest import Service

FORMS = {"json": "application/json", "html": "text/html", "pdf": "application/pdf"}


def test_a_finished_run_has_a_certificate_in_each_form(service: Service) -> None:
    run = service.complete()
    for form, media_type in FORMS.items():
        answer = service.client.get(f"/api/v1/calibrations/{run}/certificate.{form}")
        assert (answer.status_code, answer.headers["content-type"].split(";")[0]) == (200, media_type), form
        assert f'filename="certificate-{run}.{form}"' in answer.headers["content-disposition"]
    page = service.client.get(f"/api/v1/calibrations/{run}/certificate.html?language=de")
    assert 'lang="de"' in page.text
    assert page.headers["content-security-policy"].startswith("default-src 'none'")
    stated = service.client.get(f"/api/v1/calibrations/{run}/certificate.json").json()["certificate"]
    assert stated["made_by"]["station"] == service.runtime.settings.name
    assert json.loads(stated["record"]["fields"]["made_by"]) == stated["made_by"]


def test_a_run_that_moves_or_is_not_there_has_none(service: Service) -> None:
    run = service.hold()
    address = f"/api/v1/calibrations/{run}/certificate.pdf"
    refused = service.client.get(address)
    assert (refused.status_code, "has not ended" in refused.json()["detail"]) == (409, True)
    service.client.post(f"/api/v1/calibrations/{run}/abort")
    assert service.client.get("/api/v1/calibrations/99/certificate.pdf").status_code == 404
    assert service.client.get(f"{address}?language=fr").status_code == 422
