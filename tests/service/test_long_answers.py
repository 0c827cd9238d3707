"""Answers of many values are made while they are sent, and share a bound meanwhile."""

import asyncio
import tracemalloc
from contextlib import ExitStack

import numpy as np
import pytest
from fastapi.responses import StreamingResponse

from jointplay.records.channel import Channel
from jointplay.service.owners import UNTIL_ANSWERED
from jointplay.service.pieces import BUDGET
from jointplay.service.results import schemas
from jointplay.service.results.streaming import LEAST, Parts, as_json
from jointplay.service.studies import schemas as studies
from jointplay.storage.catalogue.records import BlockState
from tests.waiting import until

PLAIN = {"Accept-Encoding": "identity"}
IMPACTS = LEAST // 6 + 1


@pytest.fixture(scope="module")
def long_job(worker):
    claim = worker.start(worker.submit(output_step=1e-4))
    worker.store(claim, impacts=IMPACTS)
    worker.finish(claim, BlockState.done)
    return claim.job.id


@pytest.mark.parametrize(
    ("result", "model"),
    [
        ("history?channels=slider7.*", schemas.History),
        ("history?points=400", schemas.Overview),
        ("impacts", schemas.Impacts),
    ],
)
def test_a_long_answer_is_made_while_it_is_sent(http, long_job, result, model):
    answer = http.get(f"/v1/jobs/{long_job}/{result}", headers=PLAIN)
    assert answer.headers["Transfer-Encoding"] == "chunked"
    document = model.model_validate_json(answer.content, strict=True)
    assert document.model_dump(mode="json") == answer.json()
    assert http.get(f"/v1/jobs/{long_job}/{result}").json() == answer.json()  # compressed
    assert len(answer.json().get("impacts", [0] * IMPACTS)) == IMPACTS


def test_a_short_answer_goes_whole(http, finished_job):
    answer = http.get(f"/v1/jobs/{finished_job}/impacts", headers=PLAIN)
    assert int(answer.headers["Content-Length"]) == len(answer.content)


@pytest.mark.parametrize("result", ["history?points=400", "impacts"])
def test_what_long_answers_are_made_from_shares_a_bound(http, long_job, result, monkeypatch):
    until(lambda: BUDGET.held == 0)
    monkeypatch.setattr(BUDGET, "most", 1)
    with ExitStack() as another:
        BUDGET.take({UNTIL_ANSWERED: another}, 1)
        refused = http.get(f"/v1/jobs/{long_job}/{result}")
        assert refused.status_code == 503
        assert refused.headers["Retry-After"]
        until(lambda: BUDGET.held == 1)
    assert http.get(f"/v1/jobs/{long_job}/{result}").status_code == 200
    until(lambda: BUDGET.held == 0)


def rows_of(lengths):
    unit = Channel("x", "m", "a quantity")
    rows = [np.arange(float(length)) for length in lengths]
    return studies.Rows.of(unit, values=rows)


def test_rows_of_any_length_are_lists():
    document = rows_of([0, 2, 1])
    assert as_json(document).body == (
        b'{"unit":"m","long_name":"a quantity","values":[[],[0.0,1.0],[0.0]]}'
    )


def test_what_is_not_known_is_null():
    unit = Channel("x", "m", "a quantity")
    document = schemas.Series.of(unit, values=np.array([np.nan, np.inf, 1.5]))
    assert b'"values":[null,null,1.5]' in as_json(document).body
    document = schemas.Series.of(unit, values=Parts([[], [1.0], np.array([np.nan])], 2))
    assert b'"values":[1.0,null]' in as_json(document).body


async def lengths_of(answer):
    return [len(piece) async for piece in answer.body_iterator]


@pytest.mark.parametrize("lengths", [[1_000_000], [1000] * 1000])
def test_little_of_a_long_answer_is_there_at_a_time(lengths):
    document = rows_of(lengths)
    tracemalloc.start()
    try:
        answer = as_json(document)
        assert isinstance(answer, StreamingResponse)
        pieces = asyncio.run(lengths_of(answer))
        _, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert most < sum(pieces) / 2
    assert len(pieces) < sum(pieces) / 50_000 + 2
