"""Sensitivities over HTTP: while a job grows, of every output, and what is refused."""

import json

import numpy as np
import pytest

from jointplay.client import Client, NotFound, Refused
from jointplay.local import run
from jointplay.service.checking import Checker, CheckJob
from jointplay.service.studies.sensitivity_schema import Sensitivity
from jointplay.storage.catalogue.records import BlockState
from tests.service.answers import get
from tests.worker_by_hand import SENSITIVITY

PRESS = {"scene": {"preset": "seven-bar-press"}, **SENSITIVITY}


@pytest.fixture(scope="module")
def client(service_url):
    with Client(service_url) as found:
        yield found


@pytest.fixture(scope="module")
def computed(client, worker):
    """A sensitivity that a worker has computed."""
    job = client.submit(PRESS | {"cache": False})
    worker.work(job.id)
    return job.refresh()


def test_every_output_is_answered_as_here_and_now(http, computed):
    assert (computed.kind, computed.state) == ("sensitivity", "succeeded")
    local = run(PRESS, processes=1)
    known = computed.sensitivity()["outputs"]
    assert known == [
        *(f"displacement.{end}" for end in ("maximum", "minimum", "range", "mean")),
        *("A.impacts", "B.impacts"),
    ]
    for name in known:
        found = computed.sensitivity(name, limit=0.5, failing="below", confidence=0.9)
        assert found == local.sensitivity(name, limit=0.5, failing="below", confidence=0.9)
        query = {"output": name, "limit": 0.5, "failing": "below", "confidence": 0.9}
        answer = http.get(f"/v1/jobs/{computed.id}/sensitivity", params=query)
        document = Sensitivity.model_validate_json(answer.content, strict=True)
        assert document.model_dump(mode="json") == answer.json() == found
        assert found["rows"]["used"] == 4
        assert found["failure"]["limit"] == 0.5


def test_it_is_drawn_and_every_link_leads_somewhere(http, computed):
    links = get(http, f"/v1/jobs/{computed.id}")["links"]
    assert links.keys() >= {"points", "sensitivity", "figures", "zarr"}
    assert "sweep" not in links
    for name, link in links.items():
        answer = http.post(link) if name == "cancel" else http.get(link)
        assert answer.is_success, (name, answer.text)
    assert computed.figures == ["sensitivity"]
    for name in ("sensitivity", "displacement.range", "displacement"):
        assert computed.figure(name).content.startswith(b"\x89PNG")


def test_it_grows_row_by_row_and_failed_points_take_their_row_along(http, worker):
    job = worker.submit(**SENSITIVITY, label="grows")
    first = worker.start(job)
    worker.compute(first, failing=(5,))
    worker.finish(first, BlockState.done)
    found = get(http, f"/v1/jobs/{job}/sensitivity")
    rows = {"used": 1, "left_out": 1, "waiting": 2, "failed_points": 1, "points_each": 4}
    assert (found["complete"], found["rows"], found["measures"]) == (False, rows, {})
    assert "Less than 4 rows" in found["note"]


def test_the_design_is_stored_with_the_points(computed):
    values = computed.open("values")
    assert values.sizes == {"point": 16}
    table = np.array([values[name] for name in PRESS["parameters"]]).T.reshape(4, 4, 2)
    assert np.array_equal(table[:, 2], np.stack([table[:, 1, 0], table[:, 0, 1]], axis=1))
    assert np.array_equal(table[:, 3], np.stack([table[:, 0, 0], table[:, 1, 1]], axis=1))


@pytest.mark.parametrize(
    ("query", "parameter"),
    [
        ({"output": "displacement.maximun"}, "output"),
        ({"limit": "nan"}, "limit"),
        ({"failing": "beyond"}, "failing"),
        ({"confidence": 1.0}, "confidence"),
        ({"bootstrap": 10}, "bootstrap"),
    ],
)
def test_what_cannot_be_asked_is_refused_at_its_parameter(http, computed, query, parameter):
    answer = http.get(f"/v1/jobs/{computed.id}/sensitivity", params=query)
    assert answer.status_code == 422
    (error,) = answer.json()["errors"]
    assert error["parameter"] == parameter


def test_the_client_is_refused_alike_here_and_there(computed):
    local = run(PRESS, processes=1)
    for job in (computed, local):
        for wrong in ({"output": "x"}, {"failing": "beside"}, {"confidence": 0.2}):
            with pytest.raises(Refused) as refused:
                job.sensitivity(**wrong)
            assert [field.pointer for field in refused.value.fields] == list(wrong)


def test_a_job_of_another_kind_has_none(client, finished_sweep):
    with pytest.raises(NotFound, match="has no sensitivity"):
        client.job(finished_sweep).sensitivity()


def test_it_is_checked_in_another_process_whatever_its_length(settings, catalogue):
    """Where the sequences of its design are loaded, which takes more memory than all of an API."""
    checker = Checker(settings, catalogue)
    checker.check(CheckJob(), json.dumps(PRESS).encode())
    assert checker._jobs.running()
    checker.close()
