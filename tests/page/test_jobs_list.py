"""The list of jobs, jobs that do not go well, and a service that goes away."""

import re
import subprocess
import sys
from contextlib import ExitStack, contextmanager
from datetime import datetime, timedelta
from threading import Event, Thread
from urllib.parse import urlsplit

import pytest

from jointplay.records.job import JobError
from jointplay.service.app import create_app
from jointplay.storage.catalogue.records import BlockState, Solver
from jointplay.storage.settings import Settings
from tests.page.browsing import barriers, barriers_everywhere, expect
from tests.service_in_thread import client_of, serving
from tests.worker_by_hand import BIFURCATION

JOB = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}
SCROLLED_TO = """last => {
  const list = document.querySelector(".rows");
  list.scrollBy(0, 600);
  return list.innerText.includes(last);
}"""
CUT = ("Failed to load resource", "net::ERR")


def test_without_jobs_the_list_says_where_they_come_from(browsing, fresh_service):
    with browsing.page(f"{fresh_service}/#/jobs") as page:
        page.get_by_role("heading", name="No jobs yet").wait_for()
        assert barriers_everywhere(page) == {}
        page.get_by_label("Label", exact=True).fill("no job has this label")
        page.get_by_label("Label", exact=True).press("Enter")
        page.get_by_role("heading", name="No job matches these filters").wait_for()
        assert barriers_everywhere(page) == {}
        page.get_by_role("link", name="Show all jobs").click()
        page.get_by_role("heading", name="No jobs yet").wait_for()


def test_jobs_and_batches_have_the_addresses_of_the_api_too(browsing, http, service_url, worker):
    """They led to the lists."""
    job = worker.finished()
    batch = http.post("/v1/batches", json={"jobs": [JOB]}).raise_for_status().json()["id"]
    with browsing.page(f"{service_url}/#/jobs/{job}?phase=open") as page:
        expect(page).to_have_url(f"{service_url}/#/job/{job}?phase=open")
        page.locator(".view-job h1").wait_for()
        page.goto(f"{service_url}/#/batches/{batch}")
        expect(page).to_have_url(f"{service_url}/#/batch/{batch}")


def test_rows_say_how_long_ago_it_is_by_now(browsing, service_url, worker):
    worker.submit(label="a while ago")
    with browsing.page(f"{service_url}/#/jobs?label=a+while+ago") as page:
        when = page.locator(".row .when")
        submitted = datetime.fromisoformat(str(when.get_attribute("title")))
        for later, told in ((5.0, "just now"), (605.0, "10 min ago")):
            page.clock.set_fixed_time(submitted + timedelta(seconds=later))
            expect(when).to_have_text(told)


def test_a_job_that_only_waits_for_something_says_so(browsing, service_url, worker, catalogue):
    """It said 41 %, as if it went on."""
    waiting = worker.submit(label="stored later")
    block = worker.start(waiting).block
    catalogue.record_progress(block.id, block.attempt, 60.0, time=0.4, fraction=0.41)
    words = re.compile("^41 %.*, waiting for the results' place$")
    with browsing.page(f"{service_url}/#/jobs?label=stored+later") as page:
        expect(page.locator(".row .parameters")).to_contain_text("41 %")
        catalogue.put_off(block.id, block.attempt, "waiting for the results' place")
        expect(page.locator(".row .parameters")).to_have_text(words)
        page.goto(f"{service_url}/#/job/{waiting}")
        expect(page.get_by_text(words)).to_be_visible()


@pytest.mark.parametrize("width", [360, 1280])
def test_of_400_jobs_those_are_drawn_that_are_seen(browsing, http, service_url, artifacts, width):
    jobs = [JOB | {"label": f"number {i} of {width}"} for i in range(400)]
    http.post("/v1/batches", json={"jobs": jobs}).raise_for_status()
    with browsing.page(f"{service_url}/#/jobs?scene=pendulum", width=width) as page:
        page.get_by_text(f"number 399 of {width}", exact=True).first.wait_for()
        page.wait_for_function("() => document.querySelectorAll('.row').length < 60")
        page.wait_for_function(SCROLLED_TO, arg=f"number 0 of {width}")
        page.get_by_label("Label", exact=True).fill(f"number 7 of {width}")
        page.get_by_label("Label", exact=True).press("Enter")
        expect(page.locator(".row")).to_have_count(1)
        expect(page).to_have_url(re.compile("label=number"))
        page.screenshot(path=artifacts / f"jobs-{width}.png")
        assert barriers(page) == []
        page.get_by_role("button", name="Cancel").click()
        page.locator(".row").get_by_text("cancelled", exact=True).wait_for()


def answering(page, answer):
    """Have the page's questions answered, and return them as they come."""
    asked = []

    def seen(dialog):
        asked.append(dialog.message)
        dialog.accept() if answer[0] else dialog.dismiss()

    page.on("dialog", seen)
    return asked


def test_a_row_is_deleted_after_the_question_that_the_job_asks(browsing, http, service_url, worker):
    job = worker.finished(label="to go")
    answer = [False]
    question = "Delete this job and its results?"
    with browsing.page(f"{service_url}/#/job/{job}") as page:
        asked = answering(page, answer)
        page.get_by_role("button", name="Delete").click()
        page.goto(f"{service_url}/#/jobs?label=to+go")
        row = page.locator(f"[data-job='{job}']")
        row.get_by_role("button", name="Delete").click()
        assert asked == [question, question]
        assert http.get(f"/v1/jobs/{job}").status_code == 200
        answer[0] = True
        row.get_by_role("button", name="Delete").click()
        row.wait_for(state="detached")
        assert asked == [question] * 3
    assert http.get(f"/v1/jobs/{job}").status_code == 410


def test_chosen_jobs_are_compared_retried_and_deleted_with_one_question(
    browsing, http, service_url, worker, artifacts
):
    label = "to be chosen"
    done = [worker.finished(label=label) for _ in range(2)]
    study = worker.submit(**BIFURCATION | {"record": 7}, label=label)  # that nobody has computed
    cancelled = worker.submit(label=label, duration=0.123)
    waiting = worker.submit(label=label, duration=0.124)
    for one in (study, cancelled):
        http.post(f"/v1/jobs/{one}/cancel").raise_for_status()
    with browsing.page(f"{service_url}/#/jobs?label=to+be+chosen") as page:
        asked = answering(page, [True])

        def box(job):
            return page.locator(f"[data-job='{job}']").get_by_role("checkbox")

        for job in done:
            box(job).check()
        page.get_by_role("link", name="Compare 2").wait_for()
        expect(page.get_by_role("button", name=re.compile("^Retry [0-9]"))).to_have_count(0)
        box(study).check()
        expect(page.get_by_role("link", name="Compare 2")).to_have_count(0)
        page.get_by_role("button", name="Delete 3", exact=True).wait_for()
        page.get_by_label("All shown").check()
        page.screenshot(path=artifacts / "jobs-chosen.png")
        assert barriers_everywhere(page) == {}
        page.get_by_role("button", name="Retry 2", exact=True).click()
        expect(page.locator(".row")).to_have_count(7)
        page.get_by_role("button", name="Delete 4", exact=True).click()
        expect(page.locator(".row")).to_have_count(3)
        assert asked == ["Delete these 4 jobs and their results?"]
        expect(page.get_by_role("button", name="Delete 4", exact=True)).to_have_count(0)
    left = http.get("/v1/jobs", params={"label": label}).json()["jobs"]
    assert {job["state"] for job in left} == {"queued"}
    assert waiting in {job["id"] for job in left}


def test_a_batch_is_retried_and_deleted(browsing, http, service_url):
    jobs = [JOB | {"duration": 0.01 * n} for n in (1, 2, 3)]
    batch = http.post("/v1/batches", json={"jobs": jobs, "label": "by hand"}).json()["id"]
    with browsing.page(f"{service_url}/#/batch/{batch}") as page:
        asked = answering(page, [True])
        page.get_by_role("button", name="Cancel all").click()
        page.get_by_role("button", name="Retry 3").wait_for()
        assert barriers_everywhere(page) == {}
        page.get_by_role("button", name="Retry 3").click()
        page.wait_for_url(lambda url: batch not in url)
        page.get_by_role("button", name="Cancel all").wait_for()
        page.goto(f"{service_url}/#/batch/{batch}")
        page.get_by_role("button", name="Delete").click()
        page.wait_for_url(re.compile("#/batches$"))
        assert asked == ["Delete this batch with its 3 jobs and their results?"]
    assert http.get(f"/v1/batches/{batch}").status_code == 404


@contextmanager
def heard_of(catalogue, name, solver):
    """A worker that is heard of again and again, however long a busy browser takes."""
    ended = Event()

    def note():
        while not ended.wait(1.0):
            catalogue.note_worker(name, solver)

    catalogue.note_worker(name, solver)
    noting = Thread(target=note)
    noting.start()
    try:
        yield
    finally:
        ended.set()
        noting.join()


def test_a_job_is_followed_from_the_queue_to_its_failure(browsing, service_url, worker, catalogue):
    job_id = worker.submit(label="watched")
    with browsing.page(f"{service_url}/#/job/{job_id}") as page:
        page.get_by_text("Nothing is computed yet").wait_for()
        page.get_by_text("No worker is alive: ").wait_for()
        assert barriers_everywhere(page) == {}
        with heard_of(catalogue, "test", Solver("1", "zen4")):
            page.get_by_text("1 of 1 workers has nothing to do").wait_for()
            claim = worker.start(job_id)
            page.get_by_text("running", exact=True).wait_for()
            page.get_by_role("link", name="Document").click()
            page.get_by_role("heading", name="Who computes it").wait_for()
            page.get_by_role("cell", name="zen4").wait_for()
            page.get_by_role("link", name="Workers").click()
            page.get_by_text(f"{job_id}: block 0, for").wait_for()
        assert barriers(page) == []
        page.goto(f"{service_url}/#/job/{job_id}/document")
        worker.store(claim, complete=False)
        error = JobError("solver", "step-size-underflow", "The step fell below 1e-15 s.", 0.7)
        worker.finish(claim, BlockState.failed, error)
        page.get_by_text("The step fell below 1e-15 s.").first.wait_for()
        page.get_by_text("Another tolerance or method may help").wait_for()
        assert barriers(page) == []


@pytest.mark.parametrize(
    ("running", "most", "said"),
    [
        (0, 0, ": this begins in a moment."),
        (1, 1, ", but one block of each owner may be computed at one time: this begins when"),
        (2, 3, ": this begins in a moment, unless its owner has as many blocks computed as one"),
    ],
)
def test_a_job_that_waits_for_its_owners_others_is_not_said_to_begin(
    browsing, service_url, worker, catalogue, running, most, said
):
    """It was said to begin in a moment as long as any worker had nothing to do."""
    limits = {"running_blocks": running, "most_running_blocks": most}
    job = worker.submit(label="others first", duration=2.0 + most)
    with (
        browsing.page(f"{service_url}/#/") as page,
        heard_of(catalogue, "test", Solver("1", "zen4")),
    ):
        page.route("**/v1/usage", lambda one: one.fulfill(json=one.fetch().json() | limits))
        page.goto(f"{service_url}/#/job/{job}")
        page.get_by_text(f"1 of 1 workers has nothing to do{said}").wait_for()


def test_unknown_and_deleted_jobs_say_what_to_do(browsing, http, service_url, worker):
    gone = worker.finished()
    http.delete(f"/v1/jobs/{gone}").raise_for_status()
    for job_id, title in ((gone, "This job is gone"), ("nobody", "There is no such job")):
        with browsing.page(f"{service_url}/#/job/{job_id}", expected=CUT) as page:
            page.get_by_role("heading", name=title).wait_for()
            assert barriers(page) == []


def test_a_service_that_comes_back_is_noticed(browsing, tmp_path):
    settings = Settings(data=tmp_path / "data")
    with ExitStack() as closing:
        with serving(create_app(settings)) as url:
            http = closing.enter_context(client_of(url))
            http.post("/v1/jobs", json=JOB | {"label": "first"}).raise_for_status()
            page = closing.enter_context(browsing.page(f"{url}/#/jobs", expected=CUT))
            page.get_by_role("link", name="first").wait_for()
        page.get_by_text("Trying again …").wait_for()
        assert barriers_everywhere(page) == {}
        page.get_by_role("link", name="Mechanisms").click()
        page.get_by_role("heading", name="The service is away").wait_for()
        assert barriers_everywhere(page) == {}
        with serving(create_app(settings), urlsplit(url).port or 0):
            page.get_by_text("Trying again …").wait_for(state="hidden")
            page.get_by_role("heading", name="Mechanisms whose joints have play").wait_for()
            page.get_by_role("link", name="Jobs").click()
            second = JOB | {"label": "second", "cache": False}
            http.post("/v1/jobs", json=second).raise_for_status()
            page.get_by_role("link", name="second").wait_for()


def test_no_cost_is_said_to_be_estimated_while_the_service_is_away(browsing, service_url):
    with browsing.page(f"{service_url}/#/new/pendulum", expected=CUT) as page:
        page.get_by_text("of one core").wait_for()
        page.route("**/v1/estimates", lambda route: route.abort())
        page.get_by_label("Duration").fill("0.25")
        page.get_by_text("No estimate: it comes when the service answers again.").wait_for()
        page.unroute("**/v1/estimates")
        page.get_by_text("of one core").wait_for()


def test_a_key_is_asked_for_where_one_is_needed(browsing, tmp_path):
    folder = tmp_path / "data"
    with serving(create_app(Settings(data=folder, keys="required"))) as url:
        new = [sys.executable, "-m", "jointplay", "key", "new", "--owner", "me", "--data", folder]
        key = subprocess.run(new, capture_output=True, text=True, check=True).stdout.strip()
        with browsing.page(f"{url}/#/jobs", expected=CUT) as page:
            given = page.get_by_label("Key (jp_")
            given.fill("jp_ключ")  # which no header of a request can have
            page.get_by_role("button", name="Use it").click()
            expect(page.locator("#key:invalid")).to_be_focused()
            given.fill(f" {key} ")
            assert barriers_everywhere(page) == {}
            page.get_by_role("button", name="Use it").click()
            page.get_by_role("heading", name="No jobs yet").wait_for()
            page.goto(f"{url}/docs")
            page.locator("#operations-jobs-list_jobs_v1_jobs_get").click()
            page.get_by_role("button", name="Execute").click()
            page.locator(".live-responses-table .response-col_status", has_text="200").wait_for()


def test_a_lost_worker_is_named(browsing, service_url, worker, catalogue):
    job = worker.submit(label="lost once", duration=1.5)
    with browsing.page(f"{service_url}/#/job/{job}") as page:
        page.get_by_text("Nothing is computed yet").wait_for()
        block = catalogue.blocks(job)[0]
        assert catalogue.claim_block(block.id, "mill-7", 60.0) is not None
        page.get_by_text("running", exact=True).wait_for()
        catalogue.reap(3, ["mill-7"])
        page.get_by_text("The worker mill-7 was lost; another goes on.").wait_for()


def test_a_list_has_all_that_came_at_once(browsing, http, service_url):
    """A page may have fewer than was asked for; jobs behind it were left out for good."""
    label = "came at once"
    newest = re.compile(rf"/v1/jobs\?(?=.*page_size=20).*label={label.replace(' ', '.')}")
    with browsing.page(f"{service_url}/healthz") as page:
        page.route(
            newest,
            lambda route: route.continue_(url=route.request.url.replace("size=20", "size=2")),
        )
        page.goto(f"{service_url}/#/jobs?label={label.replace(' ', '+')}")
        for count in (1, 6):
            some = [JOB | {"label": label}] * (count - (count > 1))
            http.post("/v1/batches", json={"jobs": some}).raise_for_status()
            expect(page.locator(".row")).to_have_count(count)


def test_why_a_job_was_not_cancelled_stays_to_be_read(browsing, service_url, worker, catalogue):
    """The next word of its progress took the reason away."""
    job_id = worker.submit(label="not to be cancelled")
    claim = worker.start(job_id)
    # its progress is told before it has results, which answers 409 to who looks at once
    with browsing.page(f"{service_url}/#/job/{job_id}", expected=("500", "409")) as page:
        refused = {"title": "Broken", "detail": "It cannot be cancelled now."}
        page.route("**/cancel", lambda route: route.fulfill(status=500, json=refused))
        page.get_by_role("button", name="Cancel").click()
        reason = page.get_by_text("It cannot be cancelled now.")
        expect(reason).to_be_visible()
        catalogue.record_progress(
            claim.block.id, claim.block.attempt, 60.0, time=0.5, fraction=0.25
        )
        bar = page.get_by_label("Progress of the job")
        expect(bar).to_have_attribute("data-fraction", "0.25")
        expect(reason).to_be_visible()
