"""Long documents, and those of many bodies, are checked in another process with the same answer."""

import json
from typing import Any

import pytest

from jointplay.records.failure import LimitExceeded
from jointplay.service.batches.admission import QueueBatch
from jointplay.service.checking import SHORT, Checker, CheckJob
from jointplay.service.idempotency import SentKey
from jointplay.service.problems.handlers import refusal
from jointplay.solver.kernels.trace import length
from jointplay.solver.kernels.trace.equations import trace
from jointplay.storage.catalogue.quotas import NO_QUOTA
from tests.solver.random_mechanisms import chain

JOB: dict[str, Any] = {
    "kind": "simulate",
    "scene": {"preset": "seven-bar-press"},
    "duration": 2.0,
}
DOCUMENTS = {
    "right": JOB,
    "wrong": JOB | {"duration": -1.0, "extra": 1},
    "batch": {"jobs": [JOB, JOB | {"label": "second"}]},
    "wrong batch": {"jobs": [JOB, JOB | {"duration": 0.0}], "label": 3},
}


@pytest.fixture
def checker(settings, catalogue):
    made = Checker(settings, catalogue)
    yield made
    made.close()


def outcome(checker, catalogue, document, padding=0):
    body = json.dumps(document).encode() + b" " * padding
    try:
        if "jobs" not in document:
            return checker.check(CheckJob(), body)
        queue = QueueBatch(SentKey.made_here("ada").with_body(), "ada", NO_QUOTA)
        queued = checker.check(queue, body)
        jobs = [catalogue.get(job) for job in queued.jobs]
        return queued.batch.label, queued.created, [(job.spec, job.owner) for job in jobs]
    except Exception as error:  # noqa: BLE001 - compared
        refused = refusal(error)
        return refused.kind, refused.detail, refused.errors


@pytest.mark.parametrize("name", DOCUMENTS)
def test_the_answer_does_not_depend_on_the_process(checker, catalogue, name):
    document = DOCUMENTS[name]
    there, here = (outcome(checker, catalogue, document, padding) for padding in (SHORT, 0))
    assert there == here


def test_a_batch_whose_process_is_lost_is_queued_once(checker, catalogue):
    queue = QueueBatch(SentKey.made_here("").with_body(), "", NO_QUOTA)
    body = json.dumps(DOCUMENTS["batch"]).encode().ljust(SHORT + 1)
    first, again = (checker.check(queue, body) for _ in range(2))
    assert (first.created, again.created) == (True, False)
    assert first.jobs == again.jobs
    (newest,), _ = catalogue.page_of_batches(limit=1)
    assert newest.id == first.batch.id


def test_a_long_document_is_checked_in_another_process(checker):
    process = checker._jobs
    body = json.dumps(JOB).encode()
    for size, elsewhere in ((SHORT, False), (SHORT + 1, True)):
        checker.check(CheckJob(), body.ljust(size))
        assert bool(process.running()) == elsewhere


AXIS = {"from": 1e-4, "to": 5e-4}
MAP = {"kind": "chart", "scene": {"preset": "slider-crank"}, "settle": 1, "record": 1}


@pytest.mark.parametrize(
    ("study", "elsewhere"),
    [
        (MAP | {"by": {"parameter": "friction", "values": [0.0, 0.1]}}, False),
        (MAP | {"by": {"parameter": "friction", "values": AXIS | {"count": 400}}}, True),
        (MAP | {"by": {"parameter": "friction", "values": [1e-4 * n for n in range(300)]}}, True),
    ],
)
def test_a_short_document_of_many_points_is_checked_in_another_process(checker, study, elsewhere):
    """Forty of them at a time took what memory there is, in the process that answers everybody."""
    document = study | {"along": {"parameter": "clearance", "values": AXIS | {"count": 400}}}
    checker.check(CheckJob(), json.dumps(document).encode())
    assert bool(checker._jobs.running()) == elsewhere


def test_a_document_that_is_no_json_is_refused_alike(checker):
    kinds = []
    for padding in (0, SHORT):
        with pytest.raises(Exception) as refused:  # noqa: PT011 - two classes, one kind
            checker.check(CheckJob(), b"{" + b" " * padding)
        kinds.append(refusal(refused.value).kind)
    assert kinds[0] is not None
    assert kinds[0] == kinds[1]


def test_a_check_that_takes_too_long_is_ended_and_refused(settings, catalogue):
    scene = chain(63).model_dump()  # its equations are traced, in another process
    checker = Checker(settings, catalogue, patience=0.0)
    with pytest.raises(LimitExceeded, match="more than 0 s"):
        checker.check(CheckJob(), json.dumps(JOB | {"scene": scene}).encode())
    checker.close()
    assert checker.check(CheckJob(), json.dumps(JOB).encode()).job  # not of many bodies


def test_a_form_of_too_many_bodies_is_traced_once_for_a_whole_batch(
    checker, catalogue, monkeypatch
):
    traced = []
    monkeypatch.setattr(length, "trace", lambda *a: traced.append(a) or trace(*a))
    monkeypatch.setattr(length, "MOST_STATEMENTS", 10)
    job = JOB | {"scene": chain(8).model_dump()}
    with pytest.raises(LimitExceeded) as refused:
        QueueBatch(SentKey.made_here("").with_body(), "", NO_QUOTA)(
            {"jobs": [job, job | {"duration": 1.0}]}, checker._settings, catalogue
        )
    assert [one.pointer for one in refused.value.problems] == ["/jobs/0/scene", "/jobs/1/scene"]
    assert len(traced) == 1
