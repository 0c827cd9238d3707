"""The list of jobs while others delete them, or their states change."""

import re

from tests.page.browsing import expect


def live(label):
    return re.compile(rf"/v1/jobs\?(?=.*page_size=20).*label={label}")


def test_jobs_of_an_earlier_filter_do_not_come_into_the_list(browsing, service_url, worker):
    for label in ("sooner", "later"):
        worker.submit(label=label)
    held = []
    with browsing.page(f"{service_url}/#/jobs?label=sooner", expected=("ERR_FAILED",)) as page:
        page.route(live("sooner"), lambda route: held.append(route))
        page.wait_for_event("request", lambda one: live("sooner").search(one.url))
        page.get_by_label("Label", exact=True).fill("later")
        page.get_by_label("Label", exact=True).press("Enter")
        expect(page.locator(".row")).to_have_count(1)
        page.locator(".row").get_by_role("link", name="later").wait_for()
        held.pop().continue_()
        for _ in range(2):
            page.wait_for_event("response", lambda one: live("later").search(one.url))
        expect(page.locator(".row")).to_have_count(1)
        page.locator(".row").get_by_role("link", name="later").wait_for()


def test_a_deleted_job_does_not_come_back(browsing, http, service_url, worker):
    worker.finished(label="restored")
    before = http.get("/v1/jobs", params={"label": "restored"}).text
    held = []
    with browsing.page(f"{service_url}/#/jobs?label=restored") as page:
        page.on("dialog", lambda dialog: dialog.accept())
        page.route(
            live("restored"), lambda route: route.continue_() if held else held.append(route)
        )
        page.wait_for_event("request", lambda one: live("restored").search(one.url))
        page.locator(".row").get_by_role("button", name="Delete").click()
        page.get_by_role("heading", name="No job matches these filters").wait_for()
        held[0].fulfill(body=before)
        for _ in range(2):
            page.wait_for_event("response", lambda one: live("restored").search(one.url))
        page.get_by_role("heading", name="No job matches these filters").wait_for()


def test_a_list_goes_on_without_a_job_that_somebody_deleted(browsing, http, service_url):
    job = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}
    jobs = [job | {"label": "goes on"} for _ in range(22)]  # live are the newest 20
    batch = http.post("/v1/batches", json={"jobs": jobs}).raise_for_status().json()["id"]
    listed = http.get(f"/v1/batches/{batch}/jobs").json()["jobs"]
    oldest = min(listed, key=lambda one: one["id"])["id"]
    with browsing.page(f"{service_url}/#/jobs?label=goes+on", expected=("410",)) as page:
        row = page.locator(f"[data-job='{oldest}']")
        row.wait_for()
        http.post(f"/v1/jobs/{oldest}/cancel").raise_for_status()
        http.delete(f"/v1/jobs/{oldest}").raise_for_status()
        row.wait_for(state="detached")
        new = http.post("/v1/jobs", json=jobs[0] | {"cache": False}).json()["id"]
        page.locator(f"[data-job='{new}']").wait_for()


def test_a_finished_job_that_somebody_deleted_leaves_the_list(browsing, http, service_url, worker):
    """It stayed until the list was opened again: only jobs that go on were looked at."""
    first, gone, last = (worker.finished(label="of another") for _ in range(3))
    with browsing.page(f"{service_url}/#/jobs?label=of+another") as page:
        page.locator(f"[data-job='{gone}']").get_by_role("checkbox").check()
        page.get_by_role("button", name="Delete 1", exact=True).wait_for()
        http.delete(f"/v1/jobs/{gone}").raise_for_status()
        page.locator(f"[data-job='{gone}']").wait_for(state="detached")
        expect(page.get_by_role("button", name="Delete 1", exact=True)).to_have_count(0)
        shown = page.locator(".row").evaluate_all("rows => rows.map((row) => row.dataset.job)")
        assert sorted(shown) == sorted([first, last])
        for job in (first, last):
            http.delete(f"/v1/jobs/{job}").raise_for_status()
        page.get_by_role("heading", name="No job matches these filters").wait_for()


def test_older_jobs_that_somebody_deleted_leave_the_list_too(browsing, http, service_url):
    """Only the newest 20 were asked for again, and those that go on."""
    job = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}
    jobs = [job | {"label": "older"} for _ in range(25)]
    batch = http.post("/v1/batches", json={"jobs": jobs}).raise_for_status().json()
    http.post(f"/v1/batches/{batch['id']}/cancel").raise_for_status()
    oldest, second, third, *_ = sorted(batch["job_ids"])
    with browsing.page(f"{service_url}/#/jobs?label=older") as page:
        for one in (oldest, third):
            page.locator(f"[data-job='{one}']").get_by_role("checkbox").check()
            http.delete(f"/v1/jobs/{one}").raise_for_status()
        for one in (oldest, third):
            page.locator(f"[data-job='{one}']").wait_for(state="detached")
        page.get_by_text("23 shown").wait_for()
        page.locator(f"[data-job='{second}']").wait_for()
        expect(page.get_by_role("button", name=re.compile("^Delete [0-9]"))).to_have_count(0)


def test_jobs_leave_a_list_of_a_state_that_they_have_no_more(browsing, http, service_url):
    """The older ones stayed; one that came to the state later was put before newer ones."""
    job = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}
    jobs = [job | {"label": "by state"} for _ in range(25)]
    batch = http.post("/v1/batches", json={"jobs": jobs}).raise_for_status().json()
    second, third, *_, newest = sorted(batch["job_ids"])
    http.post(f"/v1/jobs/{newest}/cancel").raise_for_status()
    with browsing.page(f"{service_url}/#/jobs?label=by+state&state=queued") as page:
        page.locator(f"[data-job='{second}']").wait_for()
        http.post(f"/v1/jobs/{second}/cancel").raise_for_status()
        page.locator(f"[data-job='{second}']").wait_for(state="detached")
        page.locator(f"[data-job='{third}']").wait_for()
        http.delete(f"/v1/jobs/{second}").raise_for_status()
        page.goto(f"{service_url}/#/jobs?label=by+state&state=cancelled")
        page.locator(f"[data-job='{newest}']").wait_for()
        http.post(f"/v1/jobs/{third}/cancel").raise_for_status()
        page.locator(f"[data-job='{third}']").wait_for()
        expect(page.locator(".row")).to_have_count(2)
        for job, top in ((newest, "0px"), (third, "64px")):  # one below the other
            row = page.locator(f"[data-job='{job}']")
            expect(row).to_have_attribute("style", re.compile(rf"translateY\({top}\)"))
