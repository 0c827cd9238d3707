import os
import signal
import threading
import time
from collections.abc import Iterator
from dataclasses import replace

import pytest
from redis import Redis

from jointplay.service.processes.broker import Broker
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import SILENT, Unavailable
from jointplay.storage.catalogue.records import BlockEnd, BlockState, NewJob
from jointplay.storage.settings import Settings
from jointplay.worker import relay as relay_module
from jointplay.worker import tasks
from jointplay.worker.own_solver import own_solver
from jointplay.worker.process_name import own_name
from jointplay.worker.relay import Relay
from jointplay.worker.wake_up import CHANNEL, WakeUpListener, WakeUpPublisher
from tests.waiting import until

NEW = NewJob("simulate", {}, "d" * 64, "1")
FRESH, RECOVERED = "jointplay:interactive", "jointplay:recovered"


@pytest.fixture
def relay(catalogue: Catalogue, settings: Settings) -> Iterator[Relay]:
    relay = Relay(catalogue, settings)
    yield relay
    relay.release_lead()


def test_a_message_carries_a_blocks_id_and_nothing_else(
    relay: Relay, catalogue: Catalogue, redis: Redis
) -> None:
    job = catalogue.submit(NEW).job.id
    relay.do_round()
    message = redis.lindex(FRESH, 0)
    assert isinstance(message, bytes)
    assert f"{job}-0".encode() in message.replace(b"\\u002d", b"-")
    assert b"spec" not in message


def test_what_redis_forgot_is_told_again(relay: Relay, catalogue: Catalogue, redis: Redis) -> None:
    for _ in range(3):
        catalogue.submit(NEW)
    relay.do_round()
    assert redis.llen(FRESH) == 3
    redis.flushall()
    until(lambda: redis.llen(FRESH) == 3, act=relay.do_round)


def test_a_wake_up_that_redis_lost_is_not_waited_for(
    catalogue: Catalogue, settings: Settings, redis: Redis
) -> None:
    patient = Relay(catalogue, settings.model_copy(update={"republish_after": 3600.0}))
    catalogue.submit(NEW)
    patient.do_round()
    redis.flushall()
    until(lambda: redis.llen(FRESH) == 1, act=patient.do_round)
    patient.release_lead()


def test_a_wake_up_that_no_queue_has_may_be_on_its_way_to_a_worker(
    catalogue: Catalogue, settings: Settings, redis: Redis, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(relay_module, "_UNDERWAY", 0.0)
    patient = Relay(catalogue, settings.model_copy(update={"republish_after": 3600.0}))
    catalogue.submit(NEW)
    patient.do_round()
    for _ in range(2):
        redis.delete(FRESH)
        patient.do_round()
        assert redis.llen(FRESH) == 0
        until(lambda: redis.llen(FRESH) == 1, act=patient.do_round)
    patient.release_lead()


def test_a_wake_up_that_is_still_in_redis_is_not_sent_again(
    catalogue: Catalogue, settings: Settings, redis: Redis, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(relay_module, "_UNDERWAY", 0.0)
    patient = Relay(catalogue, settings.model_copy(update={"republish_after": 3600.0}))
    catalogue.submit(NEW)
    for _ in range(5):
        patient.do_round()
    assert redis.llen(FRESH) == 1
    patient.release_lead()


def test_a_claimed_block_is_told_no_more(relay: Relay, catalogue: Catalogue, redis: Redis) -> None:
    job = catalogue.submit(NEW).job.id
    other = catalogue.submit(NEW).job.id
    relay.do_round()
    catalogue.claim_block(f"{job}-0", "worker", 30)
    redis.flushall()
    until(lambda: redis.llen(FRESH) > 0, act=relay.do_round)
    assert redis.llen(FRESH) == 1
    assert other in str(redis.lindex(FRESH, 0))


def test_the_block_of_a_silent_worker_is_queued_ahead_of_others(
    relay: Relay, catalogue: Catalogue, redis: Redis
) -> None:
    job = catalogue.submit(NEW).job.id
    catalogue.claim_block(f"{job}-0", "worker", lease=0.0)
    until(lambda: redis.llen(RECOVERED) == 1, act=relay.do_round)
    assert [attempt.outcome for attempt in catalogue.attempts(job)] == ["lost"]


@pytest.mark.parametrize("jump", [60.0, -60.0], ids=["slept, or set ahead", "set back"])
def test_no_block_is_taken_back_until_the_living_had_time_for_a_heartbeat(
    catalogue: Catalogue, settings: Settings, monkeypatch: pytest.MonkeyPatch, jump: float
) -> None:
    ahead, true_time = 0.0, catalogue.clock
    monkeypatch.setattr(catalogue, "clock", lambda: true_time() + ahead)
    relay = Relay(catalogue, settings.model_copy(update={"heartbeat": 0.1, "lease": 3.0}))
    relay.do_round()
    held, lost = (catalogue.submit(NEW).job.id for _ in range(2))
    for job in (held, lost):
        catalogue.claim_block(f"{job}-0", "worker", lease=1.0)

    def act() -> None:
        relay.do_round()
        catalogue.heartbeat(f"{held}-0", 1, lease=6.0)

    ahead = jump
    began = time.monotonic()
    relay._reap_next = 0.0  # it is just about to look for leases that ran out
    until(lambda: catalogue.attempts(lost)[0].outcome == "lost", act=act)
    assert time.monotonic() - began >= 3.0  # a lease
    assert catalogue.attempts(held)[0].outcome is None
    relay.release_lead()


@pytest.mark.parametrize("relays", [1, 2])
def test_nobody_pays_for_the_time_by_which_a_clock_was_set_ahead(
    catalogue: Catalogue, settings: Settings, monkeypatch: pytest.MonkeyPatch, relays: int
) -> None:
    """An owner would have used up his core seconds of a day, and others would go before him."""
    ahead, true_time = 0.0, catalogue.clock
    monkeypatch.setattr(catalogue, "clock", lambda: true_time() + ahead)
    began = catalogue.clock()
    seeing = [Relay(catalogue, settings) for _ in range(relays)]
    for number, relay in enumerate(seeing):
        relay._name += str(number)  # a process of its own
        relay.do_round()
    held, later = (catalogue.submit(replace(NEW, owner="ada")).job.id for _ in range(2))
    catalogue.claim_block(f"{held}-0", "worker", lease=30.0)
    ahead = 36_000.0
    catalogue.claim_block(f"{later}-0", "worker", lease=30.0)
    for relay in seeing:
        relay.do_round()
    took = catalogue.clock() - began - ahead
    assert 0.0 <= catalogue.use_of("ada").computed <= 2 * took
    catalogue.finish(f"{held}-0", 1, BlockEnd(BlockState.done))
    catalogue.settle()
    took = catalogue.clock() - began - ahead
    assert 0.0 <= catalogue.use_of("ada").computed <= 2 * took
    with catalogue.connections.reading() as connection:
        (owed,) = connection.exec_driver_sql("SELECT next FROM share WHERE owner = 'ada'").one()
    assert 0.0 <= owed < 60.0  # with what the other block will probably cost
    for relay in seeing:
        relay.release_lead()


def test_what_a_process_had_that_ended_is_taken_over_before_its_time(
    relay: Relay, catalogue: Catalogue, redis: Redis
) -> None:
    host, pid, started, space = own_name().split(":", 3)
    ended = f"{host}:{pid}:{int(started) - 1}:{space}"
    lost, held = (catalogue.submit(NEW).job.id for _ in range(2))
    catalogue.claim_block(f"{lost}-0", ended, lease=1000.0)
    catalogue.claim_block(f"{held}-0", own_name(), lease=1000.0)
    assert catalogue.take_lead("relay", ended, 9.0)  # more than 10 s: the clock was set back
    relay.do_round()
    assert redis.llen(RECOVERED) == 1
    assert [attempt.outcome for attempt in catalogue.attempts(lost)] == ["lost"]
    assert [attempt.outcome for attempt in catalogue.attempts(held)] == [None]


def test_a_broker_that_dies_is_waited_for(
    relay: Relay, catalogue: Catalogue, broker: Broker, redis: Redis
) -> None:
    catalogue.submit(NEW)
    relay.do_round()
    assert broker.child.pid is not None
    os.kill(broker.child.pid, signal.SIGKILL)
    until(lambda: not broker.child.alive)
    catalogue.submit(NEW)
    relay.do_round()  # cannot send, must not raise
    broker.start()
    redis.flushall()
    until(lambda: redis.llen(FRESH) == 2, act=relay.do_round)


def test_only_one_relay_leads(
    relay: Relay, catalogue: Catalogue, settings: Settings, redis: Redis
) -> None:
    relay.do_round()
    other = Relay(catalogue, settings)
    other._name = "another machine"
    catalogue.submit(NEW)
    other.do_round()
    assert redis.llen(FRESH) == 0
    relay.release_lead()
    other.do_round()
    assert redis.llen(FRESH) == 1
    other.release_lead()


def test_a_wake_up_ends_the_relays_wait(broker: Broker) -> None:
    publisher = WakeUpPublisher(broker.url)
    heard = threading.Event()
    with WakeUpListener(broker.url) as listener:

        def listen() -> None:
            listener.wait(60)
            heard.set()

        waiting = threading.Thread(target=listen)
        waiting.start()
        until(heard.is_set, act=lambda: (publisher.publish(), heard.wait(0.05)))
        waiting.join()


def test_without_redis_a_wait_is_just_a_wait() -> None:
    began = time.monotonic()
    with WakeUpListener("unix:///nowhere.sock") as listener:
        listener.wait(0.2)
    WakeUpPublisher("unix:///nowhere.sock").publish()
    assert 0.2 <= time.monotonic() - began < 10


def test_the_results_of_deleted_jobs_are_removed(
    relay: Relay, catalogue: Catalogue, settings: Settings
) -> None:
    deleted, kept = (catalogue.submit(NEW).job.id for _ in range(2))
    for job in (deleted, kept):
        catalogue.request_cancel(job)
        settings.running_folder(job).mkdir(parents=True)
        settings.sealed_run(job, 1).put([b"results"])
    catalogue.delete(deleted)
    until(lambda: catalogue.get(deleted).removed is not None, act=relay.do_round)
    left = settings.running_folder(deleted).parent
    assert not left.exists() or list(left.iterdir()) == [settings.running_folder(kept)]
    assert not settings.running_folder(deleted).exists()
    assert not settings.sealed_run(deleted, 1).exists()
    assert settings.running_folder(kept).exists()
    assert settings.sealed_run(kept, 1).exists()
    assert catalogue.removable(10) == ()


def test_the_results_of_owners_jobs_are_measured_when_they_have_ended(
    relay: Relay, catalogue: Catalogue, settings: Settings
) -> None:
    ended, running = (catalogue.submit(replace(NEW, owner="ada")).job.id for _ in range(2))
    catalogue.request_cancel(ended)
    for job in (ended, running):
        settings.sealed_run(job, 1).put([b"results"])
        settings.sealed_run(job, 2).put([b"again"])
    until(lambda: catalogue.get(ended).stored is not None, act=relay.do_round)
    assert catalogue.get(ended).stored == len(b"resultsagain")
    assert catalogue.get(running).stored is None


def test_the_end_of_a_block_wakes_the_relay_where_owners_are_limited(
    catalogue: Catalogue, settings: Settings, redis: Redis, monkeypatch: pytest.MonkeyPatch
) -> None:
    limited = settings.model_copy(update={"most_running": 1})
    monkeypatch.setattr(tasks, "_platform", lambda: (limited, catalogue))
    job = catalogue.submit(replace(NEW, solver_version=own_solver().version)).job.id
    with redis.pubsub(ignore_subscribe_messages=True) as listening:
        listening.subscribe(CHANNEL)
        tasks.run_block(f"{job}-0")
        assert catalogue.get(job).state.terminal
        until(lambda: listening.get_message(timeout=0.1) is not None)


def test_a_worker_whose_name_is_made_up_does_not_end_the_relay(
    relay: Relay, catalogue: Catalogue, redis: Redis
) -> None:
    """A worker that joins chooses its own, and holds a block with it."""
    space = own_name().split(":", 3)[3]
    for name in (f"h:x:1:{space}", f"h:{10**30}:1:{space}"):
        job = catalogue.submit(NEW).job.id
        assert catalogue.claim_block(f"{job}-0", name, lease=30.0)
    later = catalogue.submit(NEW).job.id
    relay.do_round()
    assert later in str(redis.lrange(FRESH, 0, -1))


def test_what_goes_wrong_in_a_round_is_tried_again(
    relay: Relay, catalogue: Catalogue, redis: Redis, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail() -> tuple[str, ...]:
        raise ValueError

    catalogue.submit(NEW)
    with monkeypatch.context() as now:
        now.setattr(catalogue, "holders", fail)
        relay.turn()
    until(lambda: redis.llen(FRESH) == 1, act=relay.turn)


def test_a_relay_ends_also_while_the_catalogue_does_not_answer(
    catalogue: Catalogue, settings: Settings, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> None:
        raise Unavailable(SILENT)

    relay = Relay(catalogue, settings)
    relay.do_round()
    with monkeypatch.context() as now:
        now.setattr(catalogue, "release_lead", fail)
        relay.release_lead()
    catalogue.release_lead("relay", own_name())
