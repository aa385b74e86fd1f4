"""What a plan promises, over REST."""

from __future__ import annotations

from tests.web.conftest import Service


def test_a_plan_says_how_long_it_takes_and_how_good_it_gets(service: Service) -> None:
    document = service.client.get("/api/v1/plans/full").json()
    assert (document["plan"], len(document["stops"])) == ("full", 120)
    predicted = document["predicted"]
    assert 20.0 < predicted["duration_s"] < 50.0
    assert 500.0 < predicted["travel_deg"] < 700.0
    assert 0.9 < predicted["bound_95_mm"] < 1.3


def test_an_unknown_plan_is_refused(service: Service) -> None:
    assert service.client.get("/api/v1/plans/none").status_code == 422
