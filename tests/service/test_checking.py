"""Long documents, and those of many bodies, are checked in another process with the same answer."""

import json
from typing import Any

import pytest

from jointplay.records.failure import LimitExceeded
from jointplay.service.checking import SHORT, Checker, check_batch, check_job
from jointplay.service.problems.handlers import refusal
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
def checker(settings):
    made = Checker(settings)
    yield made
    made.close()


def outcome(checker, document, padding=0):
    body = json.dumps(document).encode() + b" " * padding
    what = check_batch if "jobs" in document else check_job
    try:
        found = checker.check(what, body, "/v1/jobs")
        return list(found.jobs), found.fingerprint, found.reuse, found.label
    except Exception as error:  # noqa: BLE001 - compared
        refused = refusal(error)
        return refused.kind, refused.detail, refused.errors


@pytest.mark.parametrize("name", DOCUMENTS)
def test_the_answer_does_not_depend_on_the_process(checker, name):
    document = DOCUMENTS[name]
    assert outcome(checker, document, SHORT) == outcome(checker, document)


def test_a_long_document_is_checked_in_another_process(checker):
    process = checker._processes[check_job]
    body = json.dumps(JOB).encode()
    for length, elsewhere in ((SHORT, False), (SHORT + 1, True)):
        checker.check(check_job, body.ljust(length))
        assert (process._process is not None) == elsewhere


def test_a_document_that_is_no_json_is_refused_alike(checker):
    kinds = []
    for padding in (0, SHORT):
        with pytest.raises(Exception) as refused:  # noqa: PT011 - two classes, one kind
            checker.check(check_job, b"{" + b" " * padding)
        kinds.append(refusal(refused.value).kind)
    assert kinds[0] is not None
    assert kinds[0] == kinds[1]


def test_a_check_that_takes_too_long_is_ended_and_refused(settings):
    scene = chain(63).model_dump()  # its equations are recorded, in another process
    checker = Checker(settings, patience=0.0)
    with pytest.raises(LimitExceeded, match="more than 0 s"):
        checker.check(check_job, json.dumps(JOB | {"scene": scene}).encode())
    checker.close()
    assert checker.check(check_job, json.dumps(JOB).encode()).jobs  # not of many bodies
