"""Branches of periodic orbits on the page: their picture, and the table of special orbits."""

import httpx

from tests.page.browsing import barriers, expect
from tests.page.conftest import submitted

SECOND = {"parameter": "amplitude", "values": {"from": 4e-3, "to": 6e-3, "count": 4}}
BRANCH = {
    "kind": "continuation",
    "scene": {"preset": "impact-oscillator"},
    "parameter": "speed",
    "values": {"from": 25.0, "to": 33.0, "count": 120},
}


def test_a_branch_is_drawn_beside_a_table_of_its_special_orbits(browsing, url, artifacts):
    job = submitted(url, BRANCH)
    with browsing.page(f"{url}/#/job/{job}") as page:
        fold = page.locator("tbody tr").filter(has_text="fold")
        expect(fold).to_contain_text("31.9303900")
        image = page.get_by_role("img", name="Branches of periodic orbits over speed")
        expect(image).to_have_js_property("complete", True)
        expect(image).not_to_have_js_property("naturalWidth", 0)
        expect(page.get_by_role("link", name="Sections")).to_have_count(0)
        plane = page.get_by_role("img", name="Multipliers of the orbits")
        expect(plane).not_to_have_js_property("naturalWidth", 0)
        page.get_by_role("button", name="LP, branch 0").click()
        told = page.get_by_role("status").filter(has_text="fold")
        expect(told).to_contain_text("multipliers 1,")
        page.screenshot(path=artifacts / "branch.png", full_page=True)
        assert barriers(page) == []
        page.set_viewport_size({"width": 700, "height": 900})  # sentences in one line would not fit
        table = page.get_by_role("group", name="Special orbits").element_handle()
        page.wait_for_function("table => table.scrollWidth === table.clientWidth", arg=table)


def test_an_orbit_is_opened_as_the_simulation_that_starts_on_it(browsing, url):
    job = submitted(url, BRANCH)
    with browsing.page(f"{url}/#/job/{job}") as page:
        page.get_by_role("button", name="LP, branch 0").click()
        page.get_by_role("button", name="Run this simulation").click()
        page.wait_for_url(lambda address: job not in address)
        opened = page.url.split("/job/")[1].split("?")[0].split("/")[0]
    made = httpx.get(f"{url}/v1/jobs/{opened}").json()["job"]
    (branch,) = httpx.get(f"{url}/v1/jobs/{job}/branch").json()["branches"]
    (row,) = [one["row"] for one in branch["special"] if one["label"] == "LP"]
    section = [
        one for name, one in branch["columns"].items() if name.startswith(("state.", "rate."))
    ]
    rate = branch["columns"]["impact_rate.stop"]
    assert made["state"] == [one["values"][row] for one in (*section, rate)]
    assert made["scene"]["parameters"]["speed"] == branch["columns"]["value"]["values"][row]


def test_curves_of_special_orbits_are_drawn_and_their_table_has_both_parameters(
    browsing, url, artifacts
):
    job = submitted(url, BRANCH | {"second": SECOND | {"curves": 1}})
    with browsing.page(f"{url}/#/job/{job}") as page:
        curve = page.locator("tbody tr").filter(has_text="LP, curve 1")
        expect(curve).to_contain_text("start of the curve")
        expect(page.get_by_role("columnheader", name="amplitude")).to_have_count(1)
        image = page.get_by_role("img", name="Special orbits over speed and amplitude")
        expect(image).to_have_js_property("complete", True)
        expect(image).not_to_have_js_property("naturalWidth", 0)
        page.screenshot(path=artifacts / "curves.png", full_page=True)
        assert barriers(page) == []


def test_the_picture_of_a_branch_grows_with_it(browsing, url):
    values = {"from": 24.0, "to": 33.0, "count": 4000}
    long = BRANCH | {"values": values, "largest_step": 1e-4}
    job = httpx.post(f"{url}/v1/jobs", json=long).json()["id"]
    with browsing.page(f"{url}/#/job/{job}") as page:
        image = page.get_by_role("img", name="Branches of periodic orbits")
        first = image.get_attribute("src")
        assert first
        expect(image).not_to_have_attribute("src", first)
    httpx.post(f"{url}/v1/jobs/{job}/cancel").raise_for_status()


def test_a_branch_is_drawn_over_a_finished_diagram_of_its_parameter(browsing, url):
    fields = {"parameter": "speed", "values": {"from": 25.0, "to": 33.0, "count": 5}}
    diagram = submitted(
        url, {"kind": "bifurcation", "scene": BRANCH["scene"], "settle": 20, "record": 4} | fields
    )
    other = fields | {"parameter": "amplitude", "values": {"from": 4e-3, "to": 6e-3, "count": 3}}
    unfit = submitted(url, {"kind": "bifurcation", "scene": BRANCH["scene"], "settle": 20} | other)
    job = submitted(url, BRANCH)
    with browsing.page(f"{url}/#/job/{job}") as page:
        image = page.get_by_role("img", name="Branches of periodic orbits over speed")
        expect(image).not_to_have_js_property("naturalWidth", 0)
        choice = page.get_by_label("Draw over")
        expect(choice.locator(f"option[value='{diagram}']")).to_have_count(1)
        expect(choice.locator(f"option[value='{unfit}']")).to_have_count(0)
        with page.expect_response(lambda one: f"branch.svg?over={diagram}" in one.url) as answer:
            choice.select_option(diagram)
        assert answer.value.ok
        expect(image).to_have_js_property("complete", True)
        expect(image).not_to_have_js_property("naturalWidth", 0)
        assert barriers(page) == []
