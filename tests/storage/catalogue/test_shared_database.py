"""A database that several machines share: PostgreSQL, whose server and network may fail alone."""

import threading
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, closing, contextmanager, suppress
from dataclasses import replace
from functools import partial
from typing import Any

import psycopg
import pytest
from sqlalchemy import Connection

from jointplay.storage.catalogue import connections
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.counters import COMPILING
from jointplay.storage.catalogue.errors import SILENT, Fenced, Interrupted, Unavailable
from jointplay.storage.catalogue.records import (
    BlockEnd,
    BlockState,
    JobState,
    NewJob,
    Solver,
    SubmissionKey,
)
from tests.postgresql_server import Server
from tests.waiting import until

NEW = NewJob("simulate", {"duration": 2.0}, "d" * 64, "0.1.0+abc")
APIS = 4


@pytest.fixture
def url(new_database: Callable[[], str]) -> str:
    return new_database()


@pytest.fixture
def apis(url: str) -> Iterator[Sequence[Catalogue]]:
    """Catalogues of several processes, which share no lock of this one."""
    with ExitStack() as stack:
        yield [stack.enter_context(closing(Catalogue(url))) for _ in range(APIS)]


def at_once(*acts: Callable[[], Any]) -> list[Any]:
    together = threading.Barrier(len(acts))

    def act(one: Callable[[], Any]) -> Any:
        together.wait()
        return one()

    with ThreadPoolExecutor(len(acts)) as threads:
        return [one.result() for one in [threads.submit(act, one) for one in acts]]


def session(catalogue: Catalogue, setting: str, **how: bool) -> str:
    with catalogue.connections.writing(**how) as connection:
        return str(connection.exec_driver_sql(f"SHOW {setting}").scalar_one())


def test_one_key_sent_to_several_at_once_makes_one_job(apis: Sequence[Catalogue]) -> None:
    for number in range(10):
        job, batch = (SubmissionKey(f"{kind} {number}", "f") for kind in ("job", "batch"))
        answers = at_once(*(partial(api.submit, NEW, job) for api in apis))
        assert len({answer.job.id for answer in answers}) == 1
        assert sum(answer.created for answer in answers) == 1
        batches = at_once(*(partial(api.submit_batch, [NEW] * 2, key=batch) for api in apis))
        assert len({answer.batch.id for answer in batches}) == 1
    assert len(apis[0].jobs(limit=1000).jobs) == 30


def test_one_job_sent_to_several_at_once_is_made_once(apis: Sequence[Catalogue]) -> None:
    for number in range(10):
        new = replace(NEW, digest=f"{number:064}")
        answers = at_once(*(partial(api.submit, new, reuse=True) for api in apis))
        assert len({answer.job.id for answer in answers}) == 1
        assert sum(answer.created for answer in answers) == 1


def test_cancelling_reaping_and_progress_never_end_a_unit(apis: Sequence[Catalogue]) -> None:
    """They lock the same rows; whoever waits for each other all the same begins anew."""

    def progress(catalogue: Catalogue, jobs: Sequence[str]) -> None:
        for job in jobs:
            with suppress(Fenced):
                catalogue.record_progress(f"{job}-0", 1, 30, time=1.0, fraction=0.5)

    for seed in range(3):
        submitted = apis[0].submit_batch([replace(NEW, digest=f"{seed:064}")] * 20)
        batch, jobs = submitted.batch.id, submitted.jobs
        for job in jobs[::2]:
            apis[0].claim_block(f"{job}-0", "worker", 0.0)
        at_once(
            partial(apis[0].cancel_batch, batch),
            partial(apis[1].reap, 3),
            partial(progress, apis[2], jobs),
            partial(progress, apis[3], jobs[::-1]),
        )
        states = Counter(job.state for job in apis[0].jobs(batch=batch).jobs)
        assert states[JobState.running] == states[JobState.queued] == 0


def test_a_submission_that_waits_for_a_deletion_leaves_the_job_deleted(
    url: str, apis: Sequence[Catalogue]
) -> None:
    later = apis[0].clock() + 3600.0
    job = apis[0].submit(replace(NEW, expires=later)).job.id
    apis[0].request_cancel(job)
    with psycopg.connect(url, autocommit=True) as server, ThreadPoolExecutor(2) as threads:
        server.execute("UPDATE job SET state = 'succeeded'")

        def wait_for_a_lock(count: int) -> None:
            waiting = "SELECT count(*) FROM pg_stat_activity WHERE wait_event_type = 'Lock'"
            until(lambda: server.execute(waiting).fetchone() == (count,))

        with psycopg.connect(url) as other:
            other.execute("SELECT * FROM job FOR UPDATE")
            deleted = threads.submit(apis[0].delete, job)
            wait_for_a_lock(1)
            found = threads.submit(apis[1].submit, NEW, reuse=True)  # which does not expire
            wait_for_a_lock(2)
        assert deleted.result().expires < later
        assert found.result().created
    assert apis[0].expired(apis[0].get(job))


def test_of_last_blocks_that_end_together_one_has_the_study_sealed(
    apis: Sequence[Catalogue],
) -> None:
    blocks = tuple((number, 1) for number in range(APIS))
    for _ in range(5):
        job = apis[0].submit(replace(NEW, blocks=blocks, seal=True)).job.id
        held = [*zip(apis, [f"{job}-{number}" for number in range(APIS)], strict=True)]
        at_once(*(partial(api.claim_block, block, "worker", 30) for api, block in held))
        at_once(*(partial(api.finish, block, 1, BlockEnd(BlockState.done)) for api, block in held))
        assert apis[0].blocks(job)[-1].state is BlockState.queued
        assert apis[0].get(job).progress_fraction == 1.0
        sequence = [event.seq for event in apis[0].events(job)]
        assert sequence == list(range(1, len(sequence) + 1))


def test_lost_connections_are_not_noticed(
    postgresql: Server, url: str, apis: Sequence[Catalogue]
) -> None:
    job = apis[0].submit(NEW).job.id
    assert apis[0].claim_block(f"{job}-0", "worker", 30)
    for act in (
        lambda: apis[0].get(job),
        lambda: apis[0].heartbeat(f"{job}-0", 1, 30),
        lambda: apis[0].record_progress(f"{job}-0", 1, 30, time=1.0, fraction=0.5),
        lambda: apis[0].submit(NEW, SubmissionKey("key", "f")),
        lambda: apis[0].reap(3),
        lambda: apis[0].finish(f"{job}-0", 1, BlockEnd(BlockState.done)),
    ):
        postgresql.cut(url)
        act()
    assert apis[0].get(job).state is JobState.succeeded


def test_what_was_done_is_not_done_again_when_only_its_answer_was_lost(
    apis: Sequence[Catalogue], monkeypatch: pytest.MonkeyPatch
) -> None:
    catalogue, solver = apis[0], Solver("0.1.0+abc", "p")
    blocks = [f"{catalogue.submit(NEW).job.id}-0" for _ in range(4)]
    database = catalogue.connections._database
    writing = database.writing
    lost: list[bool] = []

    @contextmanager
    def loses_each_first_answer(*, durable: bool) -> Iterator[Connection]:
        with writing(durable=durable) as connection:
            yield connection
        lost.append(len(lost) % 2 == 0)
        if lost[-1]:
            raise Interrupted(SILENT)

    monkeypatch.setattr(database, "writing", loses_each_first_answer)

    def answered(act: Callable[[], Any]) -> Any:
        lost.clear()
        found = act()
        assert lost == [True]
        return found

    for claim in (catalogue.claim_next, catalogue.claim_next_elsewhere):
        assert answered(partial(claim, "worker", 30.0, solver)) is not None
    for block in {*blocks} - {one.id for one in catalogue.held_by("worker")}:
        assert answered(partial(catalogue.claim_block, block, "worker", 30.0)) is not None
    assert len(catalogue.held_by("worker")) == 4
    answered(partial(catalogue.note_spent, "worker", {COMPILING: 2.0}))
    assert catalogue.census().totals[COMPILING] == 2.0
    before = [catalogue.attempts(block[:-2])[0].started for block in blocks]
    answered(partial(catalogue.pass_over, 5.0, before[0] + 1e6))
    after = [catalogue.attempts(block[:-2])[0].started for block in blocks]
    assert after == pytest.approx([moment + 5.0 for moment in before], abs=1e-3)


def test_a_connection_that_is_lost_in_mid_unit_has_it_begun_anew(
    postgresql: Server, url: str, apis: Sequence[Catalogue]
) -> None:
    moments = []

    def clock() -> float:
        if not moments:
            postgresql.cut(url)
        moments.append(1_800_000_000.0)
        return moments[-1]

    job = apis[0].submit(NEW).job.id
    apis[0].clock = clock  # type: ignore[method-assign]
    assert apis[0].claim_block(f"{job}-0", "worker", 30)
    assert len(moments) == 2
    assert [event.seq for event in apis[0].events(job)] == [1, 2, 3]


def test_a_server_that_is_restarted_is_waited_for(
    postgresql: Server, apis: Sequence[Catalogue]
) -> None:
    job = apis[0].submit(NEW).job.id
    assert apis[0].claim_block(f"{job}-0", "worker", 30)
    postgresql.stop()
    with ThreadPoolExecutor(1) as threads:
        waiting = threads.submit(apis[0].finish, f"{job}-0", 1, BlockEnd(BlockState.done))
        with pytest.raises(TimeoutError):
            waiting.result(0.1)
        postgresql.start()
        while True:  # on a machine so busy that it gives up, the worker asks again, as this does
            try:
                assert waiting.result() is JobState.succeeded
                break
            except Unavailable:
                waiting = threads.submit(apis[0].finish, f"{job}-0", 1, BlockEnd(BlockState.done))


def test_a_server_that_stays_away_is_said_to(
    monkeypatch: pytest.MonkeyPatch, postgresql: Server, url: str
) -> None:
    monkeypatch.setattr(connections, "_PATIENCE", 0.1)
    with closing(Catalogue(url.replace(str(postgresql.port), "1"))) as catalogue:
        for act in (catalogue.ping, catalogue.migrate, lambda: catalogue.submit(NEW)):
            with pytest.raises(Unavailable, match="does not answer") as silent:
                act()
            assert str(silent.value) == "the catalogue does not answer"
            (why,) = silent.value.__notes__  # in logs, and never in answers
            assert why.endswith("port 1 failed: Connection refused")
        (flaw,) = catalogue.flaws()
        assert flaw == f"does not answer: {why}"  # not libpq's question behind it


def test_rows_that_another_unit_holds_are_waited_for_and_not_for_ever(
    monkeypatch: pytest.MonkeyPatch, url: str
) -> None:
    monkeypatch.setattr(connections, "_PATIENCE", 0.2)
    with closing(Catalogue(url)) as catalogue, psycopg.connect(url) as other:
        job = catalogue.submit(NEW).job.id
        other.execute("SELECT * FROM job FOR UPDATE")
        with pytest.raises(Unavailable, match="held by another"):
            catalogue.request_cancel(job)
        assert catalogue.get(job).state is JobState.queued


def test_time_is_the_servers(postgresql: Server, url: str, apis: Sequence[Catalogue]) -> None:
    job = apis[0].submit(NEW).job
    with psycopg.connect(url) as connection:
        told = connection.execute("SELECT extract(epoch FROM clock_timestamp())::float8").fetchone()
    assert told is not None
    assert job.created <= told[0]
    assert abs(apis[1].clock() - apis[2].clock()) < 5.0
    with closing(Catalogue(url, clock=lambda: told[0] - 60.0)) as slow:  # as a worker once was
        slow.claim_block(f"{job.id}-0", "worker", 30.0)
    assert apis[0].reap(3).requeued == (f"{job.id}-0",)
    assert apis[0].claim_block(f"{job.id}-0", "worker", 30.0)
    assert apis[0].reap(3).requeued == ()


def test_what_fences_is_durable_as_what_was_accepted_is(apis: Sequence[Catalogue]) -> None:
    """A server that forgot a claim would give its attempt's number away a second time."""
    catalogue = apis[0]
    assert session(catalogue, "synchronous_commit", durable=True) == "on"
    assert session(catalogue, "synchronous_commit", durable=False) == "off"
    with catalogue.connections.claiming() as connection:
        assert connection.exec_driver_sql("SHOW synchronous_commit").scalar_one() == "on"
    with pytest.raises(ZeroDivisionError), catalogue.connections.writing(durable=False):
        _ = 1 / 0
    assert session(catalogue, "synchronous_commit", durable=True) == "on"


def test_readers_see_one_moment(apis: Sequence[Catalogue]) -> None:
    job = apis[0].submit(NEW).job.id
    with apis[0].connections.reading() as connection:
        before = connection.exec_driver_sql("SELECT state FROM job").scalar_one()
        apis[1].request_cancel(job)
        assert connection.exec_driver_sql("SELECT state FROM job").scalar_one() == before


def test_silence_is_noticed_and_connections_are_few(apis: Sequence[Catalogue]) -> None:
    assert session(apis[0], "statement_timeout") == "30s"
    assert session(apis[0], "idle_in_transaction_session_timeout") == "15s"
    assert session(apis[0], "tcp_user_timeout") == "10000"
    with ThreadPoolExecutor(40) as threads:
        list(threads.map(lambda _: apis[0].jobs(), range(200)))
    with apis[0].connections.reading() as connection:
        mine = "SELECT count(*) FROM pg_stat_activity WHERE datname = current_database()"
        assert connection.exec_driver_sql(mine).scalar_one() <= 10


def test_an_address_of_nothing_that_holds_a_catalogue_is_refused() -> None:
    with pytest.raises(ValueError, match="begin with sqlite://, postgresql://"):
        Catalogue("mysql://localhost/jobs")
    with pytest.raises(ValueError, match="no address of a database"):
        Catalogue("somewhere")


def test_a_clock_of_the_server_that_is_set_is_known_to_all_a_second_later(url: str) -> None:
    now = "pg_catalog.clock_timestamp() + (SELECT ahead FROM own.clock)"
    with psycopg.connect(url, autocommit=True) as server:
        server.execute("CREATE SCHEMA own")
        server.execute("CREATE TABLE own.clock AS SELECT interval '0' AS ahead")
        server.execute(
            f"CREATE FUNCTION own.clock_timestamp() RETURNS timestamptz LANGUAGE sql RETURN {now}"
        )
        options = "?options=-csearch_path%3Down,public,pg_catalog"
        with (
            closing(Catalogue(f"{url}{options}")) as one,
            closing(Catalogue(f"{url}{options}")) as other,
        ):
            before = [api.clock() for api in (one, other)]
            server.execute("UPDATE own.clock SET ahead = interval '1 hour'")
            until(lambda: other.jobs() and other.clock() > before[1] + 3600.0)
            until(lambda: one.jobs() and one.clock() > before[0] + 3600.0)
            assert abs(one.clock() - other.clock()) < 5.0
