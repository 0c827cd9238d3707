"""Forms that are made of what the service says of a kind, also of one from outside."""

import json
import re

import pytest

from jointplay.solver.kinds import KINDS, admit
from tests.page.browsing import barriers, expect
from tests.seams.relief import Relief


@pytest.fixture
def relief():
    KINDS["relief"] = Relief()
    yield
    del KINDS["relief"]


def shown_document(page):
    """Return the job that the page shows as JSON."""
    return json.loads(page.get_by_label("The same job", exact=True).inner_text())


@pytest.mark.usefixtures("relief")
def test_a_kind_of_two_axes_is_filled_in_submitted_and_changed(browsing, http, service_url):
    lacking = ("422", "404")  # how long each point runs; the figures of what was cancelled
    address = f"{service_url}/#/new/seven-bar-press?kind=relief"
    with browsing.page(address, expected=lacking) as page:
        expect(page.get_by_label("What to compute")).to_have_value("relief")
        page.get_by_text("Peaks and statistics over two parameters").wait_for()
        proposed = [page.get_by_label(one, exact=True).input_value() for one in ("Along", "By")]
        assert len({*proposed}) == 2
        page.get_by_label("Along", exact=True).select_option("clearance")
        page.get_by_label("By", exact=True).select_option("friction")
        for axis, *texts in (("Along", "2e-4", "4e-4", "3"), ("By", "0", "0.1", "2")):
            for end, text in zip(("from", "to", "values"), texts, strict=True):
                page.get_by_label(f"{axis}, {end}", exact=True).fill(text)
        page.get_by_label("Periods", exact=True).fill("2")
        page.get_by_role("button", name="JSON").click()
        document = shown_document(page)
        assert document == {
            "kind": "relief",
            "scene": {"preset": "seven-bar-press"},
            "along": {"parameter": "clearance", "values": {"from": 2e-4, "to": 4e-4, "count": 3}},
            "by": {"parameter": "friction", "values": {"from": 0, "to": 0.1, "count": 2}},
            "periods": 2,
        }
        assert admit(document).shape == (2, 3)
        assert barriers(page) == []
        page.get_by_role("button", name="Run", exact=True).click()
        expect(page).to_have_url(re.compile("#/job/"))
        page.get_by_role("button", name="Cancel").click()
        page.get_by_role("link", name="Run with changes").click()
        expect(page.get_by_label("By", exact=True)).to_have_value("friction")
        expect(page.get_by_label("By, values", exact=True)).to_have_value("2")
        page.goto(f"{service_url}/#/jobs?kind=relief")
        expect(page.locator(".row")).to_have_count(1)
        words = re.compile(r"clearance .* … .*, friction 0 … 0.1")
        expect(page.locator(".row")).to_contain_text(words)


def test_kinds_without_a_form_of_their_own_have_one(browsing, service_url):
    with browsing.page(f"{service_url}/#/new/slider-crank?kind=ensemble") as page:
        page.get_by_label("Members", exact=True).fill("3")
        page.get_by_role("button", name="JSON").click()
        assert shown_document(page)["members"] == 3
        page.get_by_label("What to compute").select_option("poincare")
        page.get_by_label("Record", exact=True).fill("7")
        assert shown_document(page) == {
            "kind": "poincare",
            "scene": {"preset": "slider-crank"},
            "record": 7,
        }
