"""From a card on the start page to a mechanism that moves, on real jobs."""

import csv
import re
import time
from datetime import datetime
from urllib.parse import parse_qs, urlsplit

import httpx
import pytest

from tests.page.browsing import barriers, expect
from tests.page.conftest import submitted

MOVED = "before => Number(document.querySelector('.stage canvas')?.dataset.frames ?? 0) > before"
NARROWER = """width => {
  const query = new URLSearchParams(location.hash.split("?")[1]);
  return query.get("to") - query.get("from") < width && query.has("to");
}"""


def test_the_press_moves_two_clicks_after_the_first_visit(browsing, url):
    with browsing.page(url) as page:
        page.get_by_role("button", name="Run the seven bar press", exact=True).click()
        page.wait_for_function(MOVED, arg=10)
        expect(page).to_have_url(re.compile(r"#/job/[0-9A-Z]{26}$"))
        page.get_by_text("succeeded", exact=True).wait_for()
        page.get_by_role("img", name="Journal of joint A in its bearing").wait_for()
        expect(page.locator(".uplot")).to_have_count(5)


def test_a_form_leads_to_its_job_and_refuses_what_is_wrong(browsing, url):
    with browsing.page(f"{url}/#/new/seven-bar-press") as page:
        clearance = page.get_by_label("clearance", exact=True)
        clearance.fill("-1")
        page.get_by_text("Allowed: 0 to 0.05 m.").wait_for()
        clearance.fill("3e-4")
        page.get_by_label("Duration", exact=True).fill("0.01")
        page.get_by_label("Label", exact=True).fill("<b>0.3 mm</b>")  # a text, whatever it says
        page.get_by_text("of one core").wait_for()
        page.get_by_role("button", name="curl").click()
        copied = page.get_by_label("The same job", exact=True)
        expect(copied).to_contain_text('"clearance":0.0003')
        expect(page).to_have_url(re.compile(r"clearance=0\.0003"))
        page.get_by_role("button", name="Run", exact=True).click()
        page.get_by_role("heading", name="<b>0.3 mm</b>").wait_for()
        page.wait_for_function(MOVED, arg=0)


@pytest.mark.parametrize("width", [360, 1280, 2560])
def test_a_job_can_be_read_at_every_width(browsing, url, press, artifacts, width):
    with browsing.page(f"{url}/#/job/{press}?t=0.03", width=width, still=True) as page:
        page.wait_for_function(MOVED, arg=0)
        page.locator(".uplot").nth(4).wait_for()
        page.screenshot(path=artifacts / f"job-{width}.png")
        assert barriers(page) == []


def test_long_names_of_channels_do_not_widen_a_narrow_page(browsing, url):
    """The page of a slider with play was 398 px wide in a window of 360."""
    scene = {"preset": "slider-crank", "parameters": {"clearance_guide": 1e-4}}
    job = submitted(url, {"kind": "simulate", "scene": scene, "duration": 0.001})
    channels = ",".join(f"guide.corner_{n}.normal_force" for n in (1, 2, 3, 4))
    address = f"{url}/#/job/{job}?channels={channels}"
    with browsing.page(address, width=360, still=True) as page:
        page.wait_for_function(MOVED, arg=0)
        page.locator(".uplot").nth(3).wait_for()
        assert barriers(page) == []


def test_time_is_where_the_address_says_and_impacts_lead_on(browsing, url, press):
    with browsing.page(f"{url}/#/job/{press}?t=0.03", still=True) as page:
        page.wait_for_function(MOVED, arg=0)
        page.get_by_text("t = 30 ms").wait_for()
        page.locator(".uplot").nth(4).wait_for()
        page.get_by_role("button", name="Impact ▸").click()
        page.get_by_text("t = 30 ms").wait_for(state="detached")
        with page.expect_download() as download:
            page.get_by_role("button", name="SVG", exact=True).click()
        drawing = download.value.path().read_text()
        assert drawing.startswith("<svg")
        assert drawing.count("<circle") >= 7


def test_a_history_is_zoomed_to_single_samples_and_the_address_keeps_it(browsing, url, press):
    with browsing.page(f"{url}/#/job/{press}", still=True) as page:
        page.locator(".uplot").nth(4).wait_for()
        for _ in range(7):
            page.get_by_role("button", name="Zoom in").click()
        page.wait_for_function(NARROWER, arg=0.05 / 100)  # seven times halved
        kept = page.evaluate("location.href")
        page.goto(f"{url}/#/")
        page.get_by_role("heading", name="Mechanisms whose joints have play").wait_for()
        page.goto(kept)
        page.locator(".uplot").nth(4).wait_for()
        expect(page).to_have_url(kept)
        page.get_by_role("link", name="Accuracy").click()
        page.get_by_role("heading", name="What you can trust").wait_for()
        assert barriers(page) == []


def test_phase_portrait_and_spectrum_follow_the_window_shown(browsing, url, press, artifacts):
    place = f"{url}/#/job/{press}?phase=open&spectrum=open&points=1000000"
    with browsing.page(place, still=True) as page:
        page.locator("canvas[data-points='1000000']").wait_for()
        page.get_by_text("1000000 instants, 50 ns apart.").wait_for()
        page.get_by_role(
            "img", name="Power of displacement over frequency, up to 50 kHz"
        ).wait_for()
        page.get_by_label("Points").select_option("50000")
        with page.expect_response(re.compile(r"/spectrum\?.*stop=0\.025")):
            page.get_by_role("button", name="Zoom in").click()
        page.get_by_text("50000 instants, 500 ns apart.").wait_for()
        page.screenshot(path=artifacts / "phase-and-spectrum.png", full_page=True)
        assert barriers(page) == []


def saved(page, name):
    """Return the rows of the file that a button saves."""
    with page.expect_download() as download:
        page.get_by_role("button", name=name).click()
    return list(csv.reader(download.value.path().read_text().splitlines()))


def test_what_is_shown_is_saved_as_csv(browsing, url, press):
    history = f"{url}/v1/jobs/{press}/history?channels=A.normal_force&start=0.02&stop=0.03"
    samples = httpx.get(history, trust_env=False).json()
    with browsing.page(f"{url}/#/job/{press}?channels=A.normal_force&from=0.02&to=0.03") as page:
        page.locator(".uplot").wait_for()
        head, *rows = saved(page, "Save these curves as CSV")
        assert head == ["time [s]", "A.normal_force [N]"]
        found = {round(float(time_) / 5e-6): float(force) for time_, force in rows}
        assert [*found] == [*range(4000, 6001)]  # 2000 steps of 5 us
        forces = samples["channels"]["A.normal_force"]["values"]
        for time_, force in zip(samples["time"]["values"], forces, strict=True):
            # of one polynomial; times differ by rounding, and forces by up to 1e9 N/s of that
            assert found[round(time_ / 5e-6)] == pytest.approx(force, rel=1e-9, abs=1e-6)
        page.get_by_role("link", name="Numbers").click()
        head, *rows = saved(page, "Save contacts as CSV")
    assert head[-1] == "impulse [N s]"
    impacts = httpx.get(f"{url}/v1/jobs/{press}/impacts", trust_env=False).json()["impacts"]
    expected = [(one["joint"], one["impulse"]) for one in impacts]
    assert [(joint, float(impulse)) for joint, *_, impulse in rows] == expected


def test_a_window_beyond_the_steps_that_are_kept_is_saved_and_drawn(browsing, url):
    """Both were refused: extremes are exact there, and were taken for values at any time."""
    scene = {"preset": "seven-bar-press"}
    job = {"kind": "simulate", "scene": scene, "duration": 0.05, "steps_limit": 20_000}
    made = submitted(url, job | {"output_step": 1e-4, "certificate": False})
    address = f"{url}/#/job/{made}?channels=displacement&phase=open"
    with browsing.page(address, still=True) as page:
        page.get_by_text("501 samples, the end of the window at most, 100 µs apart.").wait_for()
        _, *rows = saved(page, "Save these curves as CSV")
    assert [round(float(time_) / 1e-4) for time_, _ in rows] == [*range(501)]


def test_figures_are_saved_where_a_key_is_needed(browsing, url, press):
    """The first click saved the refusal."""
    svg = "<svg xmlns='http://www.w3.org/2000/svg' width='1' height='1'/>"

    def answer(route):
        if route.request.headers.get("authorization") == "Bearer jp_mine":
            return route.fulfill(body=svg, content_type="image/svg+xml")
        return route.fulfill(status=401, json={"detail": "This service asks for a key."})

    figures = httpx.get(f"{url}/v1/jobs/{press}/figures", trust_env=False).json()["figures"]
    with browsing.page(f"{url}/healthz") as page:
        page.evaluate("sessionStorage.setItem('jointplay-key', 'jp_mine')")
        page.route(re.compile(r"/figures/[^/]+\.(svg|png)"), answer)
        page.goto(f"{url}/#/job/{press}/figures")
        with page.expect_download() as download:
            page.get_by_role("link", name="SVG").first.click()
        assert download.value.suggested_filename == f"{figures[0]['name']}.svg"
        assert download.value.path().read_text() == svg


def test_of_contacts_that_are_too_many_the_first_are_shown(browsing, url, press):
    """Their table, and the marks of where contacts begin, were not there, without a word."""
    address = f"{url}/v1/jobs/{press}/impacts"
    onsets = [one["onset"] for one in httpx.get(address, trust_env=False).json()["impacts"]]
    most = 5
    assert len(onsets) > most

    def narrow(route):
        stop = float(parse_qs(urlsplit(route.request.url).query).get("stop", ["inf"])[0])
        if sum(onset <= stop for onset in onsets) <= most:
            return route.continue_()
        problem = {"type": "/problems/response-too-large", "title": "Too large", "status": 422}
        return route.fulfill(status=422, json=problem)

    with browsing.page(f"{url}/", expected=("422",)) as page:
        page.route("**/impacts*", narrow)
        page.goto(f"{url}/#/job/{press}/numbers")
        page.get_by_role("heading", name=f"The first {most} contacts, until ").wait_for()
        _, *rows = saved(page, "Save contacts as CSV")
        assert [float(row[1]) for row in rows] == sorted(onsets)[:most]
        page.get_by_role("link", name="Watch").click()
        page.get_by_text("a contact begins").wait_for()


def test_of_a_run_that_settles_each_tab_says_what_its_extremes_are_of(browsing, url):
    scene = {"preset": "slider-crank"}
    job = {"kind": "simulate", "scene": scene, "duration": 0.024, "settle": 0.012}
    with browsing.page(f"{url}/#/job/{submitted(url, job)}/numbers") as page:
        page.get_by_text("From 12 ms on.").wait_for()
        page.get_by_role("link", name="Accuracy").click()
        page.get_by_text("Largest values of the whole run, settling included, agree").wait_for()


def test_the_time_since_the_submission_goes_on(browsing, url, press):
    created = httpx.get(f"{url}/v1/jobs/{press}", trust_env=False).json()["created"]
    age = time.time() - datetime.fromisoformat(created).timestamp()  # s; other tests had it, too
    with browsing.page(f"{url}/#/job/{press}") as page:
        page.clock.install(time=time.time())
        page.reload()
        facts = page.locator(".facts")
        expect(facts).not_to_contain_text("10 h")
        page.clock.fast_forward(1000 * (10.5 * 3600.0 - age))
        expect(facts).to_contain_text("10 h")


def test_sections_of_a_run_are_points_of_a_plane(browsing, url, press):
    with browsing.page(f"{url}/#/job/{press}/sections") as page:
        page.get_by_label("Up").select_option("acceleration")
        page.get_by_role("img", name="1 section: acceleration over displacement").wait_for()
        expect(page).to_have_url(re.compile("y=acceleration"))
        assert barriers(page) == []
