"""From a result to the drives and back: two steps each way, no button is ever replaced."""

from __future__ import annotations

from playwright.sync_api import Page, expect

from tests.browser.conftest import Station
from tests.browser.steps import add_run, confirm, violations

MARK = "button => button.dataset.mine = 'yes'"


def press(page: Page, label: str) -> None:
    page.get_by_role("button", name=label, exact=True).click()
    confirm(page, page.get_by_role("group", name=f"Confirm: {label}"))


def test_offsets_are_applied_verified_and_rolled_back(page: Page, station: Station) -> None:
    run = add_run(station, "FB-A")
    page.goto(f"{station.url}/result/{run['id']}?open=drives")
    head, step = page.locator(".summary").first, page.get_by_role("region", name="Next step")
    drives = page.get_by_role("group", name="Drives")
    apply = step.get_by_role("button", name="Apply to drives", exact=True)
    back = drives.get_by_role("button", name="Roll back", exact=True)
    expect(head).to_contain_text("The drives hold the old zero offsets.")
    expect(apply).to_be_disabled()
    step.get_by_label("Operator").fill("ada")
    expect(apply).to_be_enabled()
    expect(back).to_be_disabled()
    back.evaluate(MARK)
    press(page, "Apply to drives")
    expect(head).to_contain_text("The drives hold these zero offsets. Verified.")
    assert violations(page) == []
    # what is done is no next step any more
    expect(step).to_contain_text("Nothing to do. The drives hold these zero offsets.")
    expect(step.get_by_role("button")).to_have_count(0)
    press(page, "Roll back")
    expect(head).to_contain_text("Rolled back: the drives hold the old zero offsets again.")
    expect(step.get_by_role("button", name="Calibrate again")).to_be_enabled()
    expect(drives.get_by_role("listitem")).to_have_count(2)
    assert back.get_attribute("data-mine") == "yes"


def test_stop_is_at_hand_while_offsets_are_written(page: Page, slow_station: Station) -> None:
    run = add_run(slow_station, "FB-B")
    page.goto(f"{slow_station.url}/result/{run['id']}?open=drives")
    head, drives = page.locator(".summary").first, page.get_by_role("group", name="Drives")
    page.get_by_role("region", name="Next step").get_by_label("Operator").fill("ada")
    press(page, "Apply to drives")
    expect(head).to_contain_text("Checking the machine")
    page.get_by_role("button", name="STOP").click()
    expect(page.get_by_role("alert").filter(has_text="both drives confirmed")).to_be_visible()
    expect(drives).to_contain_text("ABORTED")
    expect(head).to_contain_text("The drives hold the old zero offsets.")


def test_what_is_remembered_can_be_forgotten(page: Page, station: Station) -> None:
    for _ in range(2):
        ended = station.complete(robot_serial="FB-M", plan="rapid")
        assert ended["verdict"] == "pass"
    run = ended["id"]
    page.goto(f"{station.url}/result/{run}?open=memory")
    memory = page.locator(".memory")
    expect(memory).to_contain_text("Used: geometry and mechanism as earlier calibrations found them")
    expect(memory).to_contain_text(f"starts from run {run}")
    press(page, "Delete")
    expect(memory).to_contain_text("The next run starts without stored parameters.")
    expect(memory.get_by_role("button", name="Delete")).to_be_disabled()
    assert violations(page) == []
