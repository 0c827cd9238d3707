"""A service that has too much to do for a while: the page goes on as soon as that has passed."""

import json
import re
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from jointplay.storage.catalogue.records import BlockState, JobError, Solver
from tests.page.browsing import expect
from tests.page.test_own_mechanism import paste
from tests.two_assemblies import arm

BUSY = ("429", "503")
BATCH = {"jobs": [{"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}]}
MANY = 6
"""Refusals in a row: more than a request is repeated."""


@contextmanager
def refusals(page, address, status, number) -> Iterator[list[str]]:
    """Requests to an address that are refused, of which the block waits for so many."""
    refused = []

    def answer(route):
        if len(refused) == number:
            route.continue_()
        else:
            refused.append(route.request.url)
            route.fulfill(status=status, headers={"Retry-After": "0"}, json={"title": "Busy"})

    page.route(address, answer)
    yield refused
    while len(refused) < number:
        page.wait_for_event("request", lambda asked: address.search(asked.url))


@pytest.mark.parametrize("status", [429, 503])
def test_a_job_is_followed_on(browsing, service_url, worker, status):
    job_id = worker.submit(label="followed on")
    with browsing.page(f"{service_url}/healthz", expected=BUSY) as page:
        with refusals(page, re.compile("/events$"), status, 1):
            page.goto(f"{service_url}/#/job/{job_id}")
            page.get_by_text("Nothing is computed yet").wait_for()
        claim = worker.start(job_id)
        page.get_by_text("running", exact=True).wait_for()
        worker.store(claim)
        worker.finish(claim, BlockState.done)
        page.get_by_text("succeeded", exact=True).wait_for()


@pytest.mark.parametrize("is_deleted", [True, False])
def test_a_job_that_ended_unseen_is_shown_as_it_is(browsing, http, service_url, worker, is_deleted):
    """It was shown as it was last seen, for ever."""
    job_id = worker.submit(label="ended unseen")
    events = re.compile("/events$")
    with browsing.page(f"{service_url}/healthz", expected=(*BUSY, "410", "404")) as page:
        page.route(events, lambda route: route.fulfill(status=503, json={}))
        page.goto(f"{service_url}/#/job/{job_id}")
        page.get_by_text("queued", exact=True).wait_for()
        http.post(f"/v1/jobs/{job_id}/cancel").raise_for_status()
        if is_deleted:
            http.delete(f"/v1/jobs/{job_id}").raise_for_status()
            page.unroute(events)
            page.get_by_role("heading", name="This job is gone").wait_for()
        else:  # as of a stream that was cut before its last word
            page.unroute(events)
            page.route(events, lambda route: route.fulfill(status=204))
            page.get_by_text("cancelled", exact=True).wait_for()


def test_why_a_job_failed_is_told_once_the_service_is_back(browsing, service_url, worker):
    """Its state was shown alone where the service was lost as the job ended."""
    job_id = worker.submit(label="failed meanwhile")
    missed = []

    def lose(route):
        missed.append(route.request.url)
        route.abort()

    with browsing.page(f"{service_url}/#/job/{job_id}", expected=("ERR_FAILED", "404")) as page:
        page.get_by_text("Nothing is computed yet").wait_for()
        claim = worker.start(job_id)
        page.get_by_text("running", exact=True).wait_for()
        job = re.compile(f"/v1/jobs/{job_id}$")
        page.route(job, lose)
        worker.store(claim, complete=False)
        error = JobError("solver", "step-size-underflow", "The step fell below 1e-15 s.", 0.7)
        worker.finish(claim, BlockState.failed, error)
        while len(missed) < MANY:
            page.wait_for_event("request", lambda asked: job.search(asked.url))
        page.unroute(job)
        page.get_by_text("The step fell below 1e-15 s.").first.wait_for()


def test_the_editor_goes_on_once_the_service_is_back(browsing, service_url):
    """It said that it would try again, and did not."""
    checked, asked = re.compile("/v1/scenes/check$"), re.compile("/v1/scenes/(check|poses)$")
    with browsing.page(f"{service_url}/#/editor", expected=("ERR_FAILED",)) as page:
        page.locator("canvas[data-pose]").wait_for()
        page.route(asked, lambda route: route.abort())
        paste(page, json.dumps(arm(speed=1.0)))
        for _ in range(MANY):
            page.wait_for_event("requestfailed", lambda one: checked.search(one.url))
        page.unroute(asked)
        page.get_by_text("Degrees of freedom: 0.").wait_for()
        page.wait_for_function("'arm' in JSON.parse(document.querySelector('canvas').dataset.pose)")


@pytest.mark.parametrize("view", ["batches", "batch", "jobs", "workers"])
def test_lists_stay_and_go_on(browsing, http, service_url, view, worker, catalogue):
    batch = http.post("/v1/batches", json=BATCH | {"label": "to be cancelled"}).json()["id"]
    address = re.compile(f"/v1/batches/{batch}$" if view == "batch" else rf"/v1/{view}(\?.*)?$")
    with browsing.page(f"{service_url}/healthz", expected=BUSY) as page:
        page.goto(f"{service_url}/#/{view}/{batch if view == 'batch' else ''}")
        content = page.locator("#content")
        expect(content).to_contain_text("alive" if view == "workers" else "queued")
        with refusals(page, address, 429, MANY):
            pass
        http.post(f"/v1/batches/{batch}/cancel").raise_for_status()
        catalogue.note_worker("test", Solver("1", "zen4"))
        claim = worker.start(worker.submit(label="taken by somebody"))
        expect(content).to_contain_text(claim.job.id if view == "workers" else "cancelled")


def test_a_view_opens_once_there_is_room(browsing, service_url):
    with browsing.page(f"{service_url}/healthz", expected=BUSY) as page:
        with refusals(page, re.compile("/v1/batches"), 503, 1):
            page.goto(f"{service_url}/#/batches")
        expect(page.get_by_role("heading", name="Batches")).to_be_visible()
        with refusals(page, re.compile(r"/v1/scenes$"), 503, MANY):
            page.goto(f"{service_url}/#/")
        page.get_by_role("heading", name="Mechanisms whose joints have play").wait_for()
