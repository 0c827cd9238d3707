"""Names as long as they may be: no view becomes wider than its window."""

import pytest

from tests.page.browsing import barriers, expect

LONG = "Ü" * 200
NAME = "m" * 32


@pytest.fixture
def named(http, worker):
    """A batch of one finished run, with long names: the ids of both."""
    scene = http.get("/v1/scenes/pendulum").json() | {"name": NAME}
    job = {"kind": "simulate", "scene": scene, "duration": 0.01, "label": LONG}
    batch = http.post("/v1/batches", json={"jobs": [job], "label": LONG}).raise_for_status().json()
    (one,) = http.get(f"/v1/batches/{batch['id']}/jobs").json()["jobs"]
    worker.run(worker.start(one["id"]))
    return batch["id"], one["id"]


@pytest.mark.parametrize("width", [360, 1280])
def test_no_view_is_wider_than_its_window(browsing, service_url, named, width):
    batch, job = named
    addresses = [f"job/{job}", f"compare?jobs={job}", f"batch/{batch}", "batches", "jobs"]
    with browsing.page(f"{service_url}/#/job/{job}/document", width=width) as page:
        expect(page.get_by_role("heading", name=LONG)).to_be_visible()
        assert barriers(page) == []
        for address in addresses:
            page.goto(f"{service_url}/#/{address}")
            page.get_by_text(LONG).first.wait_for()
            assert barriers(page) == []
