"""From numbers that were measured to the job that looks for the parameters that give them."""

import pytest

from tests.page.browsing import barriers, expect

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
