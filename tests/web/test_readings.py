"""The readings of a run: JSON rows and the measurement file."""

from __future__ import annotations

from station.records.measurement_file import parse_measurements
from tests.web.conftest import Service

COLUMNS = {
    "reading", "t_s", "theta1_deg", "theta2_deg", "approach1", "approach2", "scale_mm", "position",
    "temperature_c", "payload_kg", "mount", "walk",
}  # fmt: skip


def test_rows_have_the_columns_of_the_measurement_file(service: Service) -> None:
    run = service.complete()
    answer = service.client.get(f"/api/v1/calibrations/{run}/readings").json()
    assert answer["next"] is None
    assert [row["reading"] for row in answer["items"]] == [1, 2, 3, 4, 5, 6]
    assert set(answer["items"][0]) == COLUMNS


def test_the_csv_reads_back_as_a_measurement_file(service: Service) -> None:
    run = service.complete()
    answer = service.client.get(f"/api/v1/calibrations/{run}/readings.csv")
    assert answer.headers["content-type"].startswith("text/csv")
    assert f"calibration-{run}-readings.csv" in answer.headers["content-disposition"]
    assert len(parse_measurements(answer.content)) == 6
    uid = service.client.get(f"/api/v1/calibrations/{run}").json()["uid"]
    assert answer.headers["run-uid"] == uid


def test_a_run_that_is_not_there_has_no_readings(service: Service) -> None:
    for form in ("readings", "readings.csv"):
        assert service.client.get(f"/api/v1/calibrations/9/{form}").status_code == 404
