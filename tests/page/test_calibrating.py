"""From numbers that were measured to the job that looks for the parameters that give them."""

import pytest

from tests.page.browsing import UNFINISHED, barriers, expect
from tests.page.test_run_with_changes import made_of, opened, shown

MEASURED = "channel,to,value\nbearing.normal_force,0.018,{}"


def test_what_was_measured_is_given_as_a_table_and_can_be_changed(browsing, url, artifacts):
    with browsing.page(f"{url}/#/new/bouncing-journal?kind=calibration&restitution=1") as page:
        measured = page.get_by_label("What was measured")
        measured.fill(MEASURED.format("much"))
        page.get_by_text("Line 2: “much” is no number for value.").wait_for()
        measured.fill(MEASURED.format(800))
        page.get_by_label("From", exact=True).fill("1e9")
        page.get_by_label("To", exact=True).fill("1e10")
        page.get_by_text("of one core").wait_for()
        page.get_by_role("button", name="JSON").click()
        copied = page.get_by_label("The same job", exact=True)
        expect(copied).to_contain_text('"spacing": "log"')
        assert barriers(page) == []
        page.screenshot(path=artifacts / "calibration-form.png", full_page=True)
        page.get_by_role("button", name="Run", exact=True).click()
        page.get_by_role("heading", name="bouncing journal · calibration").wait_for()
        page.get_by_role("button", name="Cancel").click()  # the search would take its time
        page.get_by_role("link", name="Run with changes").click()
        expect(measured).to_have_value(
            "channel,statistic,from,to,value,weight\nbearing.normal_force,maximum,0,0.018,800,1"
        )
        expect(page.get_by_label("To", exact=True)).to_have_value("10000000000")


TABLE = """async ([cases, declared]) => {
  const { casesOf, linesOf } = await import("/page/interface/measured_table.js");
  return casesOf(linesOf(cases), declared);
}"""
CHANNEL = {"channel": "A.normal_force", "statistic": "maximum", "from": 0.0, "to": 1.0}
CASES = [
    {
        "name": 'slow, "wet"; or\nnot',
        "parameters": {"speed": 2.0, "weight": 3.0, "law": "dry, hard"},
        "targets": [
            CHANNEL | {"between": [None, 5.0], "weight": 1.0, "note": "read off, by eye"},
            CHANNEL | {"between": [-1.5, 5.0], "sampled": 0.25, "absolute_tolerance": 2.0},
        ],
    },
    {"targets": [CHANNEL | {"value": 1e300, "relative_tolerance": 0.125}]},
]


def test_a_table_keeps_all_that_a_calibration_knows(browsing, service_url):
    """A target between two values, and a name with a comma, broke the form; others lost fields."""
    declared = {"speed": {}, "weight": {}, "law": {"choices": ["dry, hard"]}}
    with browsing.page(f"{service_url}/") as page:
        found = page.evaluate(TABLE, [CASES, declared])
    assert found["cases"] == CASES
    assert found["lines"] == [[2, 4], [6]]  # the name of the first has two lines


def test_run_with_changes_of_a_calibration_changes_one_line_alone(browsing, http, service_url):
    bearing = {"channel": "bearing.normal_force", "to": 0.018}
    first = bearing | {"value": 800, "relative_tolerance": 0.1, "note": "a load cell, new"}
    second = bearing | {"between": [700, None], "weight": 0.5}
    document = {
        "kind": "calibration",
        "scene": {"preset": "bouncing-journal"},
        "parameters": {"stiffness": {"minimum": 1e9, "maximum": 1e10}},
        "cases": [{"name": "steel, dry", "targets": [first, second]}],
    }
    before = made_of(http, document)
    with browsing.page(f"{service_url}/#/jobs", expected=UNFINISHED) as page:
        assert made_of(http, opened(page, service_url, before["id"]))["job"] == before["job"]
        measured = page.get_by_label("What was measured")
        measured.fill(measured.input_value().replace(",800,", ",900,"))
        now = made_of(http, shown(page))["job"]
    before["job"]["cases"][0]["targets"][0]["value"] = 900
    assert now == before["job"]


FOUND = {
    "equally_good_cost": 1.0,
    "parameters": [],
    "targets": [],
    "search": {"settled": True, "spread_settled": True, "candidates": 40},
}
FIT = """async ([found]) => {
  const { show } = await import("/page/views/job/fit.js");
  globalThis.fetch = async () => new Response(JSON.stringify(found));
  const links = { calibration: "/v1/found", figures: "/v1/figures" };
  const job = { state: "succeeded", progress: { fraction: 1 }, links };
  const room = document.createElement("div");
  const { signal } = new AbortController();
  await show(room, { job, signal, onChange: () => {} });
  return room.querySelector("p").textContent;
}"""


@pytest.mark.parametrize(("cost", "misfits"), [(7.4, True), (0.7, False)])
def test_a_fit_in_which_nothing_fits_says_so(browsing, service_url, cost, misfits):
    """The command line alone said it."""
    with browsing.page(f"{service_url}/", expected=("404",)) as page:  # of its figure
        told = page.evaluate(FIT, [FOUND | {"cost": cost, "misfits": misfits}])
    assert ("Nothing fits: " in told) is misfits


def test_a_range_keeps_the_keyboard_as_it_is_typed(browsing, service_url):
    """It was lost with the first letter."""
    with browsing.page(f"{service_url}/#/new/bouncing-journal?kind=calibration") as page:
        low = page.get_by_label("From", exact=True)
        low.fill("")
        page.keyboard.type("2.5e9")
        expect(low).to_have_value("2.5e9")
        expect(low).to_be_focused()
        page.get_by_role("button", name="Find another one").click()
        expect(page.get_by_label("From", exact=True)).to_have_count(2)
        page.get_by_role("button", name="Leave out").first.click()
        expect(page.get_by_label("From", exact=True)).to_have_count(1)
