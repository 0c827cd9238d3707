"""Forms of studies say where sections are taken, also of mechanisms that nothing drives."""

import math
import re
from typing import Any

import httpx
import pytest

from tests.page.browsing import UNFINISHED, barriers, expect
from tests.page.test_forms_of_kinds import filled, shown_document
from tests.page.test_run_with_changes import made_of, opened

ONSET = {"onset": "bearing"}
CROSSING = {"channel": "bearing.eccentricity_y", "value": -2.5e-4, "direction": "down"}


def chosen(page: Any, **words: str) -> None:
    """Choose in fields, by their labels with _ for a blank."""
    for label, word in words.items():
        page.get_by_label(label.replace("_", " "), exact=True).select_option(word)


def test_a_diagram_of_a_free_journal_is_taken_at_its_impacts(browsing, url):
    wrong = ("422",)  # the value that is never passed
    with browsing.page(f"{url}/#/new/bouncing-journal?kind=bifurcation", expected=wrong) as page:
        expect(page.get_by_label("Joint with play", exact=True)).to_have_value("bearing")
        expect(page.get_by_label("Channel", exact=True)).to_be_hidden()
        chosen(page, Parameter="restitution", Regular_or_chaotic="no")
        filled(
            page, From="0.5", To="0.9", Values="3", Sections="4"
        )  # it need not settle: it comes to rest
        page.get_by_role("button", name="JSON").click()
        assert shown_document(page)["section"] == ONSET
        assert barriers(page) == []
        page.get_by_role("button", name="Run", exact=True).click()
        expect(page).to_have_url(re.compile("#/job/"))
        page.get_by_text("succeeded", exact=True).wait_for()
        page.get_by_role("img", name=re.compile("at the sections over restitution")).wait_for()
        job = page.url.rpartition("/job/")[2].split("?")[0]
        asked = {"observable": "bearing.eccentricity_rate_y"}
        address = f"{url}/v1/jobs/{job}/bifurcation"
        found = httpx.get(address, params=asked, trust_env=False).json()["sections"]["values"]
        fall = math.sqrt(2.0 * 9.81 * 1e-3)  # m/s, through the clearance
        assert [one[0] for one in found] == pytest.approx(3 * [-fall], rel=1e-6)
        assert [len(one) for one in found] == 3 * [4]
        # journal.x is zero at all sections, journal.y the clearance
        expect(page.get_by_label("Observable")).to_have_value("journal.vy")
        page.get_by_role("link", name="Run with changes").click()
        chosen(page, Sections_are_taken="channel")
        once = page.get_by_text("An angle passes it once a turn.")
        chosen(page, Channel="journal.theta")
        expect(once).to_be_visible()
        expect(page.get_by_label("Joint with play", exact=True)).to_be_hidden()
        chosen(page, Channel="bearing.penetration", Sense="down")
        expect(once).to_have_count(0)
        filled(page, Value_that_it_passes="-7")
        page.get_by_role("button", name="Run", exact=True).click()
        page.get_by_text("it stays between -0.001 and 0.001 m").first.wait_for()
        expect(page.get_by_label("Value that it passes")).to_have_attribute("aria-invalid", "true")


LEFT = {"kind": "poincare", "scene": {"preset": "bouncing-journal"}, "section": CROSSING}
BEHIND = {
    "kind": "basin-stability",
    "scene": {"preset": "impact-oscillator"},
    "starts": {"/start/joints/stop/rate/0": {"distribution": "uniform", "low": 0, "high": 0.1}},
    "samples": 2,
    "section": {"crank_angle": 1.25},
}


@pytest.mark.parametrize(
    ("document", "fields"),
    [
        (
            LEFT,
            {
                "Sections are taken": "channel",
                "Channel": "bearing.eccentricity_y",
                "Value that it passes": "-0.00025",
                "Sense": "down",
            },
        ),
        (BEHIND, {"Sections are taken": "crank_angle", "Angle of the drive": "1.25"}),
    ],
    ids=["crossing", "angle"],
)
def test_a_section_is_kept_and_shown(browsing, http, service_url, document, fields):
    before = made_of(http, document)
    with browsing.page(f"{service_url}/#/jobs", expected=UNFINISHED) as page:
        again = opened(page, service_url, before["id"])
        for label, value in fields.items():
            expect(page.get_by_label(label, exact=True)).to_have_value(value)
        assert made_of(http, again)["job"] == before["job"]
        page.get_by_label("Sections are taken").select_option("onset")
        now = made_of(http, shown_document(page))["job"]
    joint = "bearing" if document is LEFT else "stop"
    assert now == before["job"] | {"section": {"onset": joint}}


def test_a_run_is_given_the_angle_of_its_sections(browsing, service_url):
    angle = "Poincaré sections at"
    with browsing.page(f"{service_url}/#/new/slider-crank") as page:
        filled(page, **{angle: "1.5"})
        page.get_by_role("button", name="JSON").click()
        assert shown_document(page)["section"] == {"crank_angle": 1.5}
        expect(page).to_have_url(re.compile("section_angle=1.5"))
        page.goto(f"{service_url}/#/new/pendulum")  # nothing turns it
        page.get_by_label("Duration", exact=True).wait_for()
        expect(page.get_by_label(angle)).to_have_count(0)
