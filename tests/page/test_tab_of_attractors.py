"""Shares of drawn starts on the page: their picture, and tables of attractors and of values."""

from tests.page.browsing import barriers, expect
from tests.page.conftest import submitted

STABILITY = {
    "kind": "basin-stability",
    "scene": {"preset": "impact-oscillator"},
    "starts": {
        "/start/joints/stop/eccentricity/0": {
            "distribution": "uniform",
            "low": 0.17,
            "high": 0.2,
        }
    },
    "samples": 24,
    "along": {"parameter": "speed", "values": [5.0, 28.0]},
    "settle": 100,
    "record": 4,
    "tolerance": 1e-5,
    "indicators": ["recurrence"],
}


def test_attractors_are_drawn_and_counted_at_each_value(browsing, url, artifacts):
    job = submitted(url, STABILITY)
    with browsing.page(f"{url}/#/job/{job}") as page:
        expect(page.get_by_role("link", name="Attractors")).to_have_attribute(
            "aria-current", "page"
        )
        image = page.get_by_role("img", name="How many starts end on each attractor")
        expect(image).to_have_js_property("complete", True)
        expect(image).not_to_have_js_property("naturalWidth", 0)
        values = page.get_by_role("group", name="Shares over speed").locator("tbody tr")
        expect(values).to_have_count(2)
        expect(values.nth(0)).to_contain_text("100 ± 2 %")  # 24 of 24: 1 / 50
        expect(page.get_by_role("link", name="Chart")).to_have_count(0)
        page.screenshot(path=artifacts / "basin-stability.png", full_page=True)
        assert barriers(page) == []
