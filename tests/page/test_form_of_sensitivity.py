"""Sensitivities in the page: the form that asks for one, and what its tab tells of every output."""

import re

from jointplay.solver.kinds import admit
from tests.page.browsing import UNFINISHED, barriers, expect, run_and_come_back
from tests.page.test_forms_of_kinds import shown_document
from tests.worker_by_hand import SENSITIVITY


def test_parameters_are_given_distributions_submitted_and_changed(browsing, http, service_url):
    lacking = UNFINISHED  # numbers that are typed one by one; the figures of what was cancelled
    address = f"{service_url}/#/new/seven-bar-press?kind=sensitivity"
    with browsing.page(address, expected=lacking) as page:
        expect(page.get_by_label("What to compute")).to_have_value("sensitivity")
        page.get_by_label("Parameter 1", exact=True).select_option("clearance_A")
        page.get_by_label("Parameter 2", exact=True).select_option("friction")
        page.get_by_label("Parameter 2, distribution", exact=True).select_option("normal")
        for nth, *texts in ((1, "1e-4", "5e-4"), (2, "0.1", "0.01")):
            for end, text in zip(
                ("low or mean or median", "high or standard deviation"), texts, strict=True
            ):
                page.get_by_label(f"Parameter {nth}, {end}", exact=True).fill(text)
        page.get_by_label("Samples", exact=True).fill("8")
        page.get_by_label("Periods", exact=True).fill("2")
        page.get_by_role("button", name="JSON").click()
        document = shown_document(page)
        assert document == {
            "kind": "sensitivity",
            "scene": {"preset": "seven-bar-press"},
            "parameters": {
                "clearance_A": {"distribution": "uniform", "low": 1e-4, "high": 5e-4},
                "friction": {"distribution": "normal", "mean": 0.1, "standard_deviation": 0.01},
            },
            "samples": 8,
            "periods": 2,
        }
        assert admit(document).points == 32
        assert barriers(page) == []
        run_and_come_back(page)
        expect(page.get_by_label("Parameter 2", exact=True)).to_have_value("friction")
        expect(page.get_by_label("Parameter 2, distribution", exact=True)).to_have_value("normal")
        page.goto(f"{service_url}/#/jobs?kind=sensitivity")
        expect(page.locator(".row")).to_contain_text("draws clearance_A, friction")


WITHIN = """async (found) => {
  const { within } = await import("/page/views/job/sensitivity.js");
  return found.map((one) => {
    const [values, low, high] = one.map((number) => [number]);
    return within({ values, low, high }, 0, "m");
  });
}"""


def test_the_ends_of_an_interval_are_told_apart(browsing, service_url):
    found = [[0.170312, 0.1703101, 0.1703139], [0.5, 0.25, 1.0], [0.5, 0.5, 0.5], [0.5, None, None]]
    with browsing.page(f"{service_url}/") as page:
        narrow, *others = page.evaluate(WITHIN, found)
    assert narrow == "170.312 mm (170.3101 mm … 170.3139 mm)"
    assert others == ["500 mm (250 mm … 1 m)", "500 mm (500 mm … 500 mm)", "500 mm (– … –)"]


def test_every_output_is_shown_with_its_figure_and_a_limit(browsing, worker, service_url):
    job = worker.finished_study(**SENSITIVITY, label="shown", failing=())
    with browsing.page(f"{service_url}/#/job/{job}") as page:
        page.get_by_text("4 rows of the design saltelli").wait_for()
        expect(page.get_by_label("Output", exact=True)).to_have_value("displacement.maximum")
        shown = page.get_by_role("img", name="What displacement.maximum owes to each parameter")
        expect(shown).not_to_have_js_property("naturalWidth", 0)
        with page.expect_response(lambda one: "displacement.mean.svg" in one.url and one.ok):
            page.get_by_label("Output", exact=True).select_option("displacement.mean")
        shown = page.get_by_role("img", name="What displacement.mean owes to each parameter")
        expect(shown).not_to_have_js_property("naturalWidth", 0)
        page.get_by_label("Limit", exact=True).fill("3.9")
        page.get_by_label("Limit", exact=True).blur()
        page.get_by_text(re.compile(r"Above 3\.9 m with a probability of 0\.5")).wait_for()
        expect(page.get_by_role("group", name="Parameters")).to_contain_text("clearance_B")
        expect(page.get_by_role("group", name="Quantiles")).to_contain_text("95 %")
        assert barriers(page) == []
        expect(page).to_have_url(re.compile("output=displacement.mean"))
        page.get_by_label("Limit", exact=True).fill("5 mm")
        page.get_by_label("Limit", exact=True).blur()
        page.get_by_text("This is no number; 0.0005 and 5e-4 are.").wait_for()
