"""From a form to a bifurcation diagram, and from a click on it to that simulation."""

import math
import re

import pytest

from tests.page.browsing import barriers, expect
from tests.page.test_watching import MOVED
from tests.worker_by_hand import BIFURCATION

TURNED = """async (angles) => {
  const { intoATurn } = await import("/page/plots/turns.js");
  return angles.map(intoATurn(angles));
}"""


EXPONENT = """async () => {
  const { scales } = await import("/page/plots/axes.js");
  const { drawExponents } = await import("/page/plots/verdicts.js");
  const context = Object.assign(document.createElement("canvas"), { width: 100, height: 100 })
    .getContext("2d");
  const to = scales([0, 0, 100, 100], [0, 1], [-1, 1]);
  const points = [{ value: 0.505, exponent: 0.4, error: 0.2 }];
  drawExponents(context, to, points, { faint: "#0000", "curve-0": "#000" });
  const drawn = [...context.getImageData(50, 0, 1, 100).data].filter((_, i) => i % 4 === 3);
  return [drawn.findIndex((one) => one > 0), drawn.findLastIndex((one) => one > 0)];
}"""


EXTREMES = """async () => {
  const { Quantities } = await import("/page/interface/quantities.js");
  const quantities = new Quantities(new URLSearchParams("channel=force&of=maximum"), () => {});
  const peaks = { force: { unit: "N", maximum: [1, 0.2, null] } };
  quantities.take([{ peaks, statistics: {}, status: ["done", "failed", "waiting"] }], true);
  return quantities.column("maximum").map((one) => (Number.isNaN(one) ? null : one));
}"""


def test_what_a_point_of_a_sweep_came_to_before_it_failed_is_not_drawn(browsing, service_url):
    with browsing.page(f"{service_url}/") as page:
        extremes = page.evaluate(EXTREMES)
        assert extremes == [1, None, None]


def test_exponents_of_a_diagram_have_bars_of_their_errors(browsing, service_url):
    with browsing.page(f"{service_url}/") as page:
        first, last = page.evaluate(EXPONENT)
    assert (first, last) == (20, 39)  # 0.6 and 0.2 of an axis from 1, at the top, to -1 on 100 px


def test_a_click_on_a_diagram_runs_that_simulation(browsing, url, artifacts):
    with browsing.page(f"{url}/#/new/slider-crank") as page:
        page.get_by_label("What to compute").select_option("bifurcation")
        for name, value in {"From": "1e-4", "To": "5e-4", "Values": "20"}.items():
            page.get_by_label(name, exact=True).fill(value)
        page.get_by_label("Periods to settle").fill("3")
        page.get_by_label("Sections", exact=True).fill("6")
        page.get_by_label("Regular or chaotic").select_option("no")
        page.get_by_role("button", name="Run", exact=True).click()
        page.locator("canvas[data-done='20']").wait_for()
        page.get_by_text("succeeded", exact=True).wait_for()
        assert barriers(page) == []
        page.locator("canvas[data-done='20']").click(position={"x": 500, "y": 100})
        chosen = page.get_by_label("clearance", exact=True)
        expect(chosen).not_to_have_value("")
        page.get_by_role("button", name="Run this simulation").wait_for()
        page.screenshot(path=artifacts / "diagram.png")
        value = float(chosen.input_value())
        assert 1e-4 <= value <= 5e-4
        page.get_by_role("button", name="Run this simulation").click()
        page.wait_for_function(MOVED, arg=0)
        expect(page.get_by_role("heading", level=1)).to_have_text(re.compile("^clearance = "))


TELLING = """async (lists) => {
  const { telling } = await import("/page/plots/telling.js");
  return lists.map(telling);
}"""


def test_the_first_observable_that_changes_is_found(browsing, service_url):
    still = {"unit": "m", "values": [[0.0, 1e-19], [2e-19]]}  # by rounding alone
    edge = {"unit": "m", "values": [[-5e-4, -5e-4 - 1e-13], [-5e-4]]}
    rate = {"unit": "m/s", "values": [[-0.14, -0.12], [-0.14]]}
    turned = {"unit": "rad", "values": [[0.0, 2 * math.pi], [4 * math.pi, -1e-12]]}
    swung = {"unit": "rad", "values": [[0.1, 0.2]]}
    lists = [{"x": still, "y": edge, "vy": rate}, {"crank": turned, "rod": swung}, {"y": edge}]
    with browsing.page(f"{service_url}/") as page:
        found = page.evaluate(TELLING, lists)
    assert found == ["vy", "rod", None]


def test_an_observable_that_is_chosen_stays_while_the_diagram_grows(
    browsing, http, service_url, worker, catalogue
):
    job_id = worker.submit(**BIFURCATION)
    observables = http.get(f"/v1/jobs/{job_id}").json()["job"]["observables"]
    with browsing.page(f"{service_url}/#/job/{job_id}/diagram") as page:
        bar = page.get_by_label("Progress of the job")
        for block, done in enumerate((8, 16)):
            claim = worker.start(job_id, block)
            worker.compute(claim)
            name = observables[1 if block else 0]
            words = f"{name} at the sections over clearance: {done} of 20 values are computed"
            shown = page.get_by_role("img", name=words)
            for nth in range(
                1000
            ):  # the page looks once a second at most, when it hears of progress
                reached = {"time": 0.0, "fraction": 0.5 + nth / 2000}
                before = bar.get_attribute("data-fraction")
                catalogue.record_progress(claim.block.id, claim.block.attempt, 60.0, **reached)
                expect(bar).not_to_have_attribute("data-fraction", before)
                if shown.count():
                    break
            shown.wait_for()
            if not block:
                page.get_by_label("Observable").select_option(observables[1])


def test_a_sweep_over_two_parameters_is_a_map(browsing, service_url, finished_sweep, artifacts):
    with browsing.page(f"{service_url}/#/job/{finished_sweep}") as page:
        page.get_by_role("img", name=re.compile("over clearance and friction")).wait_for()
        round_pi = [3.1, 3.1 - 2 * math.pi, 3.2 + 4 * math.pi]  # angles that go round, at pi
        turned = [page.evaluate(TURNED, angles) for angles in (round_pi, [1.0, 7.0])]
        assert turned == [pytest.approx([3.1, 3.1, 3.2]), [1.0, 7.0]]
        page.get_by_label("Quantity").select_option("minimum")
        expect(page).to_have_url(re.compile("of=minimum"))
        page.get_by_role("img", name="minimum of").wait_for()
        page.screenshot(path=artifacts / "map.png")
        assert barriers(page) == []
        page.get_by_role("img", name="minimum of").click(position={"x": 100, "y": 40})
        page.get_by_text("clearance = 100 µm, friction = 0.05").wait_for()  # the upper left
        page.get_by_role("button", name="Run this simulation").click()
        page.get_by_role("heading", name="clearance = 100 µm, friction = 0.05").wait_for()


def test_a_sweep_over_three_parameters_is_a_map_at_each_value_of_the_third(
    browsing, service_url, worker
):
    """All were drawn over one another, and a click chose a point of any."""
    grid = {"clearance": [1e-4, 2e-4], "friction": [0.0, 0.05], "restitution": [0.5, 0.75]}
    job = worker.finished_study(kind="sweep", grid=grid, periods=1)
    with browsing.page(f"{service_url}/#/job/{job}") as page:
        page.get_by_role("img", name="over clearance and friction, at restitution = 0.5").wait_for()
        page.get_by_label("At", exact=True).select_option("restitution = 0.75")
        drawn = page.get_by_role("img", name="over clearance and friction, at restitution = 0.75")
        drawn.click(position={"x": 100, "y": 40})  # the upper left: points 2 and 3
        chosen = page.get_by_text("clearance = 100 µm, friction = 0.05, restitution = 0.75")
        expect(chosen).to_be_visible()
        page.get_by_label("Quantity").select_option("maximum")
        drawn.click(position={"x": 100, "y": 40})
        expect(page.get_by_text("maximum 4 ", exact=False)).to_be_visible()
        assert barriers(page) == []


def test_a_sweep_over_one_parameter_has_curves_of_what_is_known(
    browsing, service_url, worker, artifacts
):
    grid = {"clearance": [1e-4, 2e-4, 3e-4, 4e-4]}
    kept = ["mean", "standard_deviation", "contact_share"]
    job = worker.finished_study(kind="sweep", grid=grid, periods=1, statistics=kept)
    with browsing.page(f"{service_url}/#/job/{job}", width=360) as page:
        page.get_by_text("mean ± standard deviation").wait_for()
        page.get_by_text("As a table").click()
        page.get_by_role("button", name="Choose point 3").click()
        page.get_by_text("maximum 3 ", exact=False).first.wait_for()
        page.get_by_text("clearance = 300 µm").wait_for()
        assert barriers(page) == []
        page.screenshot(path=artifacts / "sweep.png", full_page=True)
        page.get_by_label("Of", exact=True).select_option("A.contact_share")
        page.get_by_role("img", name="A.contact_share [1] over clearance").wait_for()


UNITS = {
    (0.00035, "m"): [1e-3, "mm"],
    (0.05, "m"): [1e-3, "mm"],
    (0.5, "m"): [1, "m"],
    (25000, "m"): [1e3, "10³ m"],
    (2e5, "m/s^2"): [1e3, "10³ m/s²"],
    (3e6, "rad/s^2"): [1e6, "10⁶ rad/s²"],
    (25000, "N"): [1e3, "kN"],
    (2e-5, "m/s"): [1e-6, "µm/s"],
    (0.001, "rad"): [1, "rad"],
    (0.001, "1"): [1, ""],
}
DOTS = """async (count) => {
  const { drawCloud } = await import("/page/plots/cloud.js");
  const { scales } = await import("/page/plots/axes.js");
  const context = new OffscreenCanvas(400, 400).getContext("2d");
  const some = Array.from({ length: count }, (_, i) => i / count);
  drawCloud(context, scales([0, 0, 400, 400], [-0.1, 1.1], [-0.1, 1.1]),
    [{ x: some, y: some, colour: "#000000" }]);
  const { data } = context.getImageData(0, 0, 400, 400);
  return data.filter((one, i) => i % 4 === 3 && one > 0).length / count;
}"""


def test_axes_have_the_units_of_figures_and_few_points_are_large(browsing, service_url):
    with browsing.page(f"{service_url}/#/jobs") as page:
        for (largest, unit), expected in UNITS.items():
            found = page.evaluate(
                """async ([largest, unit]) =>
                  (await import("/page/interface/numbers.js")).axisUnit(unit, largest)""",
                [largest, unit],
            )
            assert found == expected, (largest, unit)
        two, some, many = (page.evaluate(DOTS, count) for count in (2, 200, 2000))
    assert two > 28 > some > 5 > many, (two, some, many)


AXES = """async (domain) => {
  const { drawAxes, scales } = await import("/page/plots/axes.js");
  const context = new OffscreenCanvas(900, 500).getContext("2d");
  const written = [];
  context.fillText = (text) => written.push(text);
  drawAxes(context, scales([80, 10, 800, 400], [0, 1], domain), { yLabel: "place [m]" }, {});
  return written.slice(written.indexOf("") + 1);
}"""


def test_numbers_that_differ_in_late_digits_stand_beside_an_axis(browsing, service_url):
    """A periodic motion has such sections: their digits were cut off at the picture's edge."""
    with browsing.page(f"{service_url}/#/jobs") as page:
        wide, narrow = (page.evaluate(AXES, [-5e-3, -5e-3 + width]) for width in (1e-3, 1e-12))
    assert wide[-1] == "place [mm]"
    assert wide[0] == "−5"
    *marks, label = narrow
    assert label.startswith("place + 5 mm [")
    assert (marks[0], label.count("[")) == ("0", 1)
    assert max(map(len, marks)) <= 9


WRITTEN = """() => {
  const write = CanvasRenderingContext2D.prototype.fillText;
  window.written = new Set();
  CanvasRenderingContext2D.prototype.fillText = function (text, ...at) {
    window.written.add(text);
    write.call(this, text, ...at);
  };
}"""


def test_axes_of_histories_have_the_units_of_figures(browsing, url, press):
    shown = "channels=displacement,acceleration,A.normal_force,A.penetration"
    with browsing.page(f"{url}/#/job/{press}?{shown}", still=True) as page:
        page.locator(".uplot").nth(3).wait_for()
        page.evaluate(WRITTEN)
        page.get_by_title("Zoom in").click()
        page.wait_for_function("() => window.written.has('time [s]')")
        written = page.evaluate("() => [...window.written]")
    assert {"mm", "m/s²", "N"} <= {*written}  # of a penetration


def test_two_runs_are_compared_in_the_same_plots(browsing, url, press, artifacts):
    with browsing.page(f"{url}/#/compare?jobs={press},{press}", still=True) as page:
        page.locator(".uplot").nth(3).wait_for()
        page.wait_for_function(MOVED, arg=0)
        expect(page.locator("main .swatch")).to_have_count(2)
        page.screenshot(path=artifacts / "compared.png")
        assert barriers(page) == []


def test_the_reference_of_the_api_needs_nothing_from_elsewhere(browsing, service_url):
    with browsing.page(f"{service_url}/docs") as page:
        page.locator("#operations-jobs-submit_job_v1_jobs_post").wait_for()


def test_a_choice_that_does_not_come_is_told(browsing, http, service_url, worker):
    """The picture before stayed under the new name, without a word."""
    study = worker.finished_study(**BIFURCATION)
    observables = http.get(f"/v1/jobs/{study}").json()["job"]["observables"]
    first, broken, other = observables[:3]
    address = f"{service_url}/#/job/{study}/diagram?observable={first}"
    with browsing.page(address, expected=("500",)) as page:
        page.locator("canvas[data-done]").wait_for()
        failing = re.compile(rf"/bifurcation\?.*{re.escape(broken)}")
        refused = {"title": "Broken", "detail": "It broke."}
        page.route(failing, lambda route: route.fulfill(status=500, json=refused))
        page.get_by_label("Observable").select_option(broken)
        told = page.get_by_text(f"This is still {first}. It broke.")
        expect(told).to_be_visible()
        page.get_by_label("Observable").select_option(other)
        page.get_by_role("img", name=f"{other} at the sections").wait_for()
        expect(told).to_have_count(0)


def test_the_run_of_a_point_lasts_some_turns_of_that_point(browsing, http, service_url, worker):
    """It lasted four turns of the shipped mechanism: at a tenth of its speed not half a turn."""
    slow = 50.0  # rad/s
    scene = {"preset": "slider-crank"}
    values = {"scene": scene, "parameter": "speed", "values": [slow, 500.0]}
    study = worker.finished_study(**(BIFURCATION | values | {"indicators": []}))
    with browsing.page(f"{service_url}/#/job/{study}", expected=("409", "404")) as page:
        page.locator("canvas[data-done='2']").wait_for()
        at = page.get_by_label("speed", exact=True)
        at.fill("slow")
        at.press("Enter")
        page.get_by_text("“slow” is no number").wait_for()
        at.fill("51")
        at.press("Enter")
        expect(at).to_have_value("50")
        page.get_by_role("button", name="Run this simulation").click()
        expect(page.get_by_role("heading", level=1)).to_have_text("speed = 50 rad/s")
        page.get_by_role("button", name="Cancel").click()
        (job,) = http.get("/v1/jobs", params={"label": "speed = 50 rad/s"}).json()["jobs"]
    assert job["job"]["duration"] == pytest.approx(4 * 2 * math.pi / slow, rel=0.05)  # two digits


CANCELLED = """async () => {
  const { ChartMap } = await import("/page/charts/map.js");
  const axis = { parameter: "p", unit: "m", values: [1, 2, 3] };
  const { signal } = new AbortController();
  const map = new ChartMap({ x: axis, y: axis }, signal, () => {}, () => {});
  map.canvas.setPointerCapture = () => {}; // no pointer is there
  const send = (name) => map.canvas.dispatchEvent(new PointerEvent(name));
  send("pointerdown");
  const held = map.from !== null;
  send("pointercancel");
  return [held, map.from];
}"""


def test_a_map_that_a_browser_scrolls_is_let_go(browsing, service_url):
    with browsing.page(f"{service_url}/") as page:
        held, after = page.evaluate(CANCELLED)
    assert (held, after) == (True, None)
