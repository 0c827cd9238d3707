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
