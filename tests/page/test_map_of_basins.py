"""Maps of basins on the page: their attractors, and the run of one start."""

import re

import httpx
import pytest

from tests.page.browsing import barriers, expect
from tests.page.conftest import submitted

BASINS = {
    "kind": "basins",
    "scene": {"preset": "impact-oscillator", "parameters": {"speed": 28.0}},
    "along": {
        "start": "/start/joints/stop/eccentricity/0",
        "values": {"from": 0.17, "to": 0.2, "count": 12},
    },
    "by": {"start": "/start/joints/stop/rate/0", "values": {"from": -0.5, "to": 0.5, "count": 8}},
    "settle": 100,
    "record": 4,
    "tolerance": 1e-5,
    "indicators": ["recurrence"],
}
MAP = "stop.eccentricity_rate_x over stop.eccentricity_x; arrows move, plus and minus scale"


@pytest.fixture(scope="module")
def basins(url):
    return submitted(url, BASINS)


def test_attractors_stand_in_a_table_and_a_click_runs_a_start(browsing, url, basins, artifacts):
    with browsing.page(f"{url}/#/job/{basins}") as page:
        rows = page.locator("tbody tr")
        expect(rows).to_have_count(2)
        expect(rows.nth(0)).to_contain_text("period-1 A")
        expect(rows.nth(1)).to_contain_text("period-1 B")
        page.get_by_text(re.compile("boundary")).wait_for()
        expect(page.get_by_label("Shown")).to_have_value("attractor")
        page.screenshot(path=artifacts / "basins.png", full_page=True)
        assert barriers(page) == []
        place = page.get_by_label(MAP).bounding_box()
        page.mouse.click(place["x"] + place["width"] / 2, place["y"] + place["height"] / 2)
        page.get_by_role("status").filter(has_text="attractor: period-1").wait_for()
        page.get_by_role("button", name="Run this simulation").click()
        page.get_by_role("heading", name=re.compile("stop.eccentricity_x = ")).wait_for()
        (job,) = re.findall(r"#/job/(\w+)", page.url)
    start = httpx.get(f"{url}/v1/jobs/{job}").json()["job"]["scene"]["start"]["joints"]["stop"]
    assert 0.17 < start["eccentricity"][0] < 0.2
    assert start["eccentricity"][1] == start["rate"][1] == 0.0
    assert -0.5 < start["rate"][0] < 0.5
