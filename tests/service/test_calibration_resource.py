"""A calibration over HTTP: submitted with what was measured, computed, and read."""

import pytest

from jointplay import jobs
from jointplay.client import Client, NotFound, Refused, ResultsNotReady
from jointplay.records.calibration_misfit import with_misfits
from jointplay.service.studies.calibration_schema import Calibration
from jointplay.solver.kinds import admit
from tests.service.answers import get
from tests.solver.calibration.calibrations import BOUNCE, computed

SHORT = {"search": {"population": 4, "generations": 6}, "spread": {"generations": 4}}
JOB = jobs.calibration(
    "bouncing-journal", BOUNCE["parameters"], BOUNCE["cases"], friction=0.0, **SHORT
)


@pytest.fixture(scope="module")
def client(service_url):
    with Client(service_url) as found:
        yield found


@pytest.fixture(scope="module")
def finished(client, worker):
    """A calibration that a worker has computed."""
    job = client.submit(JOB)
    with pytest.raises(ResultsNotReady):
        _ = job.calibration
    worker.work(job.id)
    return job.refresh()


def test_the_client_reads_what_the_local_command_finds(finished, http):
    assert (finished.kind, finished.state) == ("calibration", "succeeded")
    found = finished.calibration
    expected = with_misfits(computed(JOB).document())
    assert found == expected
    history = found["search"]["best_costs"]
    assert history == sorted(history, reverse=True)
    answer = http.get(f"/v1/jobs/{finished.id}/calibration")
    document = Calibration.model_validate_json(answer.content, strict=True)
    assert document.model_dump(mode="json") == answer.json()


def test_every_link_of_a_calibration_leads_somewhere(finished, http):
    links = get(http, f"/v1/jobs/{finished.id}")["links"]
    assert links.keys() >= {"calibration", "figures", "zarr"}
    for name, link in links.items():
        answer = http.post(link) if name == "cancel" else http.get(link)
        assert answer.is_success, (name, answer.text)


def test_its_figure_is_drawn(finished):
    assert finished.figures == ["calibration"]
    assert finished.figure("calibration").content.startswith(b"\x89PNG")


def test_a_calibration_is_estimated_before_it_is_queued(client):
    estimate = client.estimate(JOB)
    assert (estimate.points, estimate.blocks, estimate.failure) == (1, 1, None)
    assert estimate.steps > 1000


def test_one_that_is_cancelled_has_found_nothing(client):
    job = client.submit(JOB | {"label": "cancelled", "cache": False})
    job.cancel()
    with pytest.raises(NotFound, match="computed nothing"):
        _ = job.calibration


def test_what_was_measured_is_checked_before_anything_is_queued(client):
    wrong = {"channel": "bearing.normal_forse", "to": 0.01, "value": 1.0}
    with pytest.raises(Refused) as refused:
        client.submit(JOB | {"cases": [{"targets": [wrong]}]})
    (problem,) = refused.value.fields
    assert problem.pointer == "/cases/0/targets/0/channel"
    assert "bearing.normal_force" in problem.detail
    with pytest.raises(Refused) as refused:
        client.submit(JOB | {"cases": [{"targets": [wrong] * 257}]})
    assert "/cases/0/targets" in {field.pointer for field in refused.value.fields}


def test_the_document_that_a_worker_plans_from_is_the_admitted_one():
    first = admit(JOB)
    assert admit(first.job).digest == first.digest
