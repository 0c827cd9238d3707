"""The keyboard stays where it is while a view is drawn anew, every second or two."""

import re

import pytest

from tests.page.browsing import expect

BATCH = {"jobs": [{"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}]}


@pytest.mark.parametrize("view", ["batches", "batch"])
def test_a_link_keeps_the_keyboard_as_its_table_changes(browsing, http, service_url, view):
    batch = http.post("/v1/batches", json=BATCH | {"label": "looked at"}).json()["id"]
    address = f"{service_url}/#/{view}/{batch}" if view == "batch" else f"{service_url}/#/batches"
    with browsing.page(address) as page:
        rows = page.locator("tbody tr")
        link = rows.first.locator("a")
        link.focus()
        http.post(f"/v1/batches/{batch}/cancel").raise_for_status()
        expect(rows.first).to_contain_text("cancelled")
        expect(link).to_be_focused()


def test_a_button_of_a_job_keeps_it_as_the_job_goes_on(browsing, service_url, worker, catalogue):
    job_id = worker.submit(label="goes on")
    claim = worker.start(job_id)
    with browsing.page(f"{service_url}/#/jobs?label=goes+on") as page:
        button = page.get_by_role("button", name=re.compile("Cancel"))
        button.focus()
        for percent in (25, 50):
            reached = {"time": percent / 50.0, "fraction": percent / 100.0}
            catalogue.record_progress(claim.block.id, claim.block.attempt, 60.0, **reached)
            expect(page.locator(".row")).to_contain_text(f"{percent} %")
            expect(button).to_be_focused()


def test_the_content_is_skipped_to_and_its_view_stays(browsing, service_url):
    """Its address was taken for that of a view, which there is not."""
    with browsing.page(f"{service_url}/#/new/slider-crank") as page:
        page.get_by_label("Label", exact=True).fill("kept")
        skip = page.get_by_role("link", name="Skip to the content")
        skip.focus()
        skip.press("Enter")
        expect(page.locator("#content")).to_be_focused()
        expect(page.get_by_label("Label", exact=True)).to_have_value("kept")
        expect(page).to_have_url(re.compile("#/new/slider-crank"))


def test_an_address_of_no_view_says_so(browsing, service_url):
    with browsing.page(f"{service_url}/#/toString") as page:
        expect(page.get_by_text("There is no view “toString”.")).to_be_visible()


def test_a_button_keeps_the_keyboard_while_it_works(browsing, url, press):
    """It was disabled meanwhile: the next key went to the page."""
    held = []
    with browsing.page(f"{url}/#/job/{press}/numbers", still=True) as page:
        saving = page.get_by_role("button", name="Save extremes as CSV")
        saving.focus()
        for _ in range(2):
            with page.expect_download():
                page.keyboard.press("Enter")
        page.route("**/v1/jobs", lambda route: held.append(route))  # no answer yet
        again = page.get_by_role("button", name="Run again")
        again.focus()
        page.keyboard.press("Enter")
        expect(again).to_have_attribute("aria-disabled", "true")
        expect(again).to_be_focused()
