"""Charts on the page: a map that is moved and scaled, its legend, and one point of it."""

import json
import re

import pytest

from tests.page.browsing import barriers, expect, slowly
from tests.page.conftest import running, submitted

CHART = {
    "kind": "chart",
    "scene": {"preset": "impact-oscillator"},
    "along": {"parameter": "speed", "values": {"from": 10.0, "to": 40.0, "count": 12}},
    "by": {"parameter": "amplitude", "values": {"from": 1e-3, "to": 2e-2, "count": 8}},
    "settle": 4,
    "record": 4,
    "tolerance": 1e-5,
    "indicators": ["recurrence"],
}
MAP = "amplitude over speed; arrows move, plus and minus scale"
PAINTED = """label => {
  const { dataset } = document.querySelector(`canvas[aria-label="${label}"]`) ?? {};
  return dataset?.waiting === "0" && JSON.parse(dataset.view);
}"""
COLOURS = """label => {
  const canvas = document.querySelector(`canvas[aria-label="${label}"]`);
  const { width, height } = canvas;
  const { data } = canvas.getContext("2d").getImageData(width / 2, height / 2, 1, 1);
  return [...data];
}"""


@pytest.fixture(scope="module")
def chart(url):
    return submitted(url, CHART)


def painted(page):
    """Return the view once all of its tiles are there."""
    return page.wait_for_function(PAINTED, arg=MAP).json_value()


def test_a_chart_is_moved_and_scaled_like_a_map(browsing, url, chart, artifacts):
    with browsing.page(f"{url}/#/job/{chart}") as page:
        whole = painted(page)
        page.get_by_text("96 points. Drag to move").wait_for()
        assert whole["corner"] == [0, 0]
        page.screenshot(path=artifacts / "chart.png")
        place = page.get_by_label(MAP).bounding_box()
        middle = place["x"] + place["width"] / 2, place["y"] + place["height"] / 2
        page.mouse.move(*middle)
        page.mouse.wheel(0, -100)
        page.wait_for_function(f"label => ({PAINTED})(label)?.corner[0] > 0", arg=MAP)
        near = painted(page)
        assert near["scale"][0] == pytest.approx(1.25 * whole["scale"][0])
        page.mouse.down()
        page.mouse.move(middle[0] + 20, middle[1])
        page.mouse.up()
        page.wait_for_function(
            f"([label, before]) => ({PAINTED})(label)?.corner[0] < before",
            arg=[MAP, near["corner"][0]],
        )
        page.mouse.dblclick(*middle)
        page.wait_for_function(f"label => ({PAINTED})(label)?.corner[0] === 0", arg=MAP)
        assert barriers(page) == []


def test_a_legend_says_what_the_colours_mean_and_a_click_offers_the_run(browsing, url, chart):
    with browsing.page(f"{url}/#/job/{chart}") as page:
        painted(page)
        legend = page.locator(".legend li")
        expect(legend.filter(has_text="period-1 (")).to_have_count(1)
        swatch = legend.first.locator(".swatch").evaluate("one => getComputedStyle(one).background")
        assert "rgb(" in swatch
        page.get_by_label("Shown").select_option("onsets")
        expect(page).to_have_url(re.compile("quantity=onsets"))
        painted(page)
        shade = page.evaluate(COLOURS, MAP)
        assert shade[3] == 255
        place = page.get_by_label(MAP).bounding_box()
        page.mouse.click(place["x"] + place["width"] / 2, place["y"] + place["height"] / 2)
        page.get_by_role("button", name="Run this simulation").wait_for()
        told = page.get_by_role("status").filter(has_text="kind of motion: ")
        expect(told).to_have_text(re.compile(r"after which the motion recurs: (\d+|none); "))


def test_a_point_that_does_not_come_is_told(browsing, url, chart):
    """The point before stayed below the map, with its button."""
    with browsing.page(f"{url}/#/job/{chart}", expected=("500",)) as page:
        painted(page)
        place = page.get_by_label(MAP).bounding_box()
        x, y = place["x"] + place["width"] / 2, place["y"] + place["height"] / 2
        page.mouse.click(x, y)
        page.get_by_role("button", name="Run this simulation").wait_for()
        refused = {"title": "Broken", "detail": "It broke."}
        page.route("**/chart/point*", lambda route: route.fulfill(status=500, json=refused))
        page.mouse.click(x, y - 60)
        expect(page.get_by_text("It broke.")).to_be_visible()
        expect(page.get_by_role("button", name="Run this simulation")).to_have_count(0)


def test_a_map_is_moved_with_keys(browsing, url, chart):
    with browsing.page(f"{url}/#/job/{chart}") as page:
        painted(page)
        page.get_by_label(MAP).focus()
        page.keyboard.press("+")
        page.wait_for_function(f"label => ({PAINTED})(label)?.corner[0] > 0", arg=MAP)
        before = painted(page)["corner"]
        page.keyboard.press("ArrowRight")
        page.wait_for_function(
            f"([label, before]) => ({PAINTED})(label)?.corner[0] > before", arg=[MAP, before[0]]
        )
        assert json.dumps(painted(page)) != json.dumps(before)


def test_a_line_of_a_chart_is_cut_as_a_diagram(browsing, url, chart):
    with browsing.page(f"{url}/#/job/{chart}") as page:
        painted(page)
        place = page.get_by_label(MAP).bounding_box()
        page.mouse.click(place["x"] + place["width"] / 2, place["y"] + place["height"] / 2)
        page.get_by_role("button", name="Diagram over speed").click()
        page.get_by_role("heading", name="bifurcation").wait_for()
        page.get_by_text("speed 10 rad/s … 40 rad/s, amplitude").wait_for()


def test_a_refined_chart_says_how_much_of_it_inherits(browsing, url):
    refined = submitted(url, CHART | {"refine": 2, "statistics": ["impacts"]})
    with browsing.page(f"{url}/#/job/{refined}") as page:
        painted(page)
        page.get_by_text(re.compile(r"^\d+ points were not computed: the corners")).wait_for()
        page.get_by_label("Shown").select_option("inherited")
        painted(page)
        assert barriers(page) == []


def test_a_diagram_cut_from_rows_follows_their_neighbours(browsing, url):
    chained = submitted(url, CHART | {"continuation": "backward"})
    with browsing.page(f"{url}/#/job/{chained}") as page:
        painted(page)
        place = page.get_by_label(MAP).bounding_box()
        page.mouse.click(place["x"] + place["width"] / 2, place["y"] + place["height"] / 2)
        page.get_by_role("button", name="Diagram over speed").click()
        page.get_by_role("heading", name="bifurcation").wait_for()
        found = page.url.rpartition("/")[2].partition("?")[0]
        job = page.request.get(f"{url}/v1/jobs/{found}").json()["job"]
        assert (job["continuation"], job["chains"]) == ("backward", 1)


def test_a_branch_begins_at_a_point_whose_motion_is_periodic(browsing, url):
    few = {"along": {"parameter": "speed", "values": [10.0, 40.0]}}
    few |= {"by": {"parameter": "amplitude", "values": [1e-3, 2e-3]}, "settle": 80}
    chart = submitted(url, CHART | few)
    with browsing.page(f"{url}/#/job/{chart}") as page:
        painted(page)
        place = page.get_by_label(MAP).bounding_box()
        page.mouse.click(place["x"] + 0.7 * place["width"], place["y"] + 0.7 * place["height"])
        page.get_by_role("button", name="Branch over speed").click()
        page.get_by_role("heading", name="continuation").wait_for()
        found = page.url.rpartition("/")[2].partition("?")[0]
        job = page.request.get(f"{url}/v1/jobs/{found}").json()["job"]
        assert (job["parameter"], job["period"], job["at"]) == ("speed", 1, 40.0)
        assert job["values"] == {"from": 10.0, "to": 40.0, "count": 200, "spacing": "linear"}
        assert job["scene"]["parameters"]["amplitude"] == 1e-3
        page.request.post(f"{url}/v1/jobs/{found}/cancel")


def test_a_chart_is_asked_for_in_the_form(browsing, url):
    with browsing.page(f"{url}/#/new/impact-oscillator?kind=chart") as page:
        page.get_by_label("Along", exact=True).select_option("speed")
        page.get_by_label("By", exact=True).select_option("amplitude")
        for label, value in (
            ("Along, from", 10),
            ("Along, to", 40),
            ("Along, values", 3),
            ("By, from", 0.001),
            ("By, to", 0.002),
            ("By, values", 2),
            ("Settle", 2),
            ("Record", 4),
        ):
            page.get_by_label(label, exact=True).fill(str(value))
        page.get_by_role("button", name="Run", exact=True).click()
        page.get_by_text("6 points. Drag to move").wait_for()
        painted(page)


@pytest.mark.parametrize(("starts", "words"), [(1, ""), (2, "2 starts a point, ")])
def test_its_head_says_how_many_starts_a_point_has(browsing, url, starts, words):
    job = submitted(url, CHART | {"starts": starts})
    with browsing.page(f"{url}/#/job/{job}") as page:
        values = page.locator("dt", has_text="Values").locator("+ dd")
        expect(values).to_have_text(f"{words}speed 10 rad/s … 40 rad/s, amplitude 1 mm … 20 mm")


GROUND = """() => {
  const one = document.body.appendChild(document.createElement("i"));
  one.style.color = "var(--ground)";
  return [...getComputedStyle(one).color.matchAll(/\\d+/g)].map(Number).join();
}"""
WATCHED = """([label, ground]) => {
  const canvas = document.querySelector(`canvas[aria-label="${label}"]`);
  const colour = () => {
    const { width, height } = canvas;
    const { data } = canvas.getContext("2d").getImageData(width / 2, height / 2, 1, 1);
    return [...data].slice(0, 3).join();
  };
  window.seen = { drawn: false, blank: 0, told: new Set() };
  const look = () => {
    const blank = colour() === ground;
    if (!blank && colour() !== "0,0,0") window.seen.drawn = true;
    if (window.seen.drawn) {
      window.seen.told.add(document.body.textContent.match(/.{12}points are computed/)?.[0]);
      if (blank) window.seen.blank += 1;
    }
    requestAnimationFrame(look);
  };
  look();
}"""
"""Looks at the middle of a map at every frame from now on."""
GROWN = "() => window.seen.told.size >= 4"
"""Asked by a wait that has a limit: a loop in the page that never ends would wait for ever."""


def test_a_map_that_grows_faster_than_its_tiles_come_is_never_blank(browsing, url):
    along, by = (CHART[name]["values"] | {"count": 600} for name in ("along", "by"))
    axes = {"along": CHART["along"] | {"values": along}, "by": CHART["by"] | {"values": by}}
    with (
        running(url, CHART | axes | {"settle": 40}) as job,
        browsing.page(f"{url}/#/jobs", expected=("willReadFrequently",)) as page,
    ):
        slowly(page, "**/tiles/**")
        page.goto(f"{url}/#/job/{job}")
        page.get_by_label(MAP).wait_for()
        page.evaluate(WATCHED, [MAP, page.evaluate(GROUND)])
        page.wait_for_function(GROWN)
        page.wait_for_function("() => window.seen.blank === 0")


def test_a_chart_without_a_point_says_so_and_fills_in(browsing, service_url, worker, catalogue):
    """Its whole view was replaced: “Cannot read properties of undefined”."""
    job_id = worker.submit(**CHART)
    claim = worker.start(job_id)
    worker.compute(claim, points=1, sections=0)
    reached = {"time": 0.0, "fraction": 0.1}
    catalogue.record_progress(claim.block.id, claim.block.attempt, 60.0, **reached)
    with browsing.page(f"{service_url}/#/job/{job_id}") as page:
        page.get_by_text("The first points are shown here as soon as they are computed.").wait_for()
        page.get_by_role("button", name="Cancel").wait_for()
