"""Every view, narrow and wide, light and dark: axe finds no barrier, nothing is cut off."""

import pytest

from tests.page.browsing import barriers
from tests.solver.calibration.calibrations import bounce
from tests.worker_by_hand import ACCURACY_STUDY, BIFURCATION

ALL = [(360, False), (360, True), (1280, False), (1280, True), (2560, False)]
BATCH = {"jobs": [{"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}]}


@pytest.fixture(scope="module")
def places(http, worker, finished_sweep):
    """Where views are, and what is there once they are filled; second those of other tests."""
    run = worker.finished()
    diagram = worker.finished_study(**BIFURCATION)
    accuracy = worker.finished_study(**ACCURACY_STUDY)
    fit = worker.submit(**bounce(search={"population": 4, "generations": 4}))
    worker.work(fit)
    batch = http.post("/v1/batches", json=BATCH).raise_for_status().json()["id"]
    return {
        "new": ("/#/new/slider-crank", ".fields input"),
        "batch": (f"/#/batch/{batch}", "tbody tr"),
        "costs": (f"/#/job/{accuracy}", "tbody tr"),
        "fit": (f"/#/job/{fit}", "tbody tr"),
        "numbers": (f"/#/job/{run}/numbers", "tbody tr"),
        "figures": (f"/#/job/{run}/figures", "figure img[src]"),
        "document": (f"/#/job/{run}/document", "tbody tr"),
        "report": ("/report", "h1"),
        "workers": ("/#/workers", ".panel p"),
        "reference": ("/docs", "#operations-jobs-submit_job_v1_jobs_post"),
    }, {
        "start": ("/", ".card canvas"),
        "jobs": ("/#/jobs", ".row"),
        "editor": ("/#/editor", ".cm-content"),
        "window": (f"/#/job/{run}?phase=open&spectrum=open", ".uplot"),
        "compared": (f"/#/compare?jobs={run},{run}", ".uplot"),
        "diagram": (f"/#/job/{diagram}", "canvas[data-done]"),
        "map": (f"/#/job/{finished_sweep}", "canvas[aria-label]"),
        "accuracy": (f"/#/job/{run}/accuracy", ".panel"),
        "sections": (f"/#/job/{run}/sections", "canvas[data-points]"),
    }


def wrong(browsing, url, places, width, dark, artifacts):
    """Faults in each of these places, of each of which a picture is kept."""
    found = {}
    look = f"{width}-dark" if dark else f"{width}"
    with browsing.page(f"{url}/", width=width, dark=dark, still=True) as page:
        for name, (place, there) in places.items():
            page.goto("about:blank")  # or what is there of the view before would be looked at
            page.goto(f"{url}{place}")
            page.locator(there).first.wait_for()
            found[name] = barriers(page)
            page.screenshot(path=artifacts / f"{name}-{look}.png", full_page=True)
    return {name: one for name, one in found.items() if one}


def test_no_view_that_no_other_test_looks_at_has_a_barrier(
    browsing, service_url, places, artifacts
):
    assert wrong(browsing, service_url, places[0], 360, True, artifacts) == {}


@pytest.mark.long
@pytest.mark.parametrize(("width", "dark"), ALL)
def test_no_view_has_a_barrier_at_any_width(browsing, service_url, places, artifacts, width, dark):
    assert wrong(browsing, service_url, places[0] | places[1], width, dark, artifacts) == {}
