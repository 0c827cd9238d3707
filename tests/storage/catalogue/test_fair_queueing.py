"""Owners whose work waits are served alike, however much each has submitted, and in which way."""

from collections.abc import Callable
from contextlib import closing
from dataclasses import replace
from heapq import heappop, heappush
from itertools import combinations, cycle

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from stepped_clock import Clock

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.fair_queueing import HEAD_START, MOST_BEHIND
from jointplay.storage.catalogue.records import BlockEnd, BlockState, Claim, NewJob, Solver

SOLVER = Solver("1", "skylake")
RUN = NewJob("simulate", {}, "d" * 64, "1")
OWNERS = ("ada", "bob", "eve")


def submit(catalogue: Catalogue, owner: str, count: int = 1) -> list[str]:
    """Submit jobs that come alone."""
    return [catalogue.submit(replace(RUN, owner=owner)).job.id for _ in range(count)]


def batch(catalogue: Catalogue, owner: str, count: int) -> None:
    catalogue.submit_batch([replace(RUN, owner=owner)] * count, owner=owner)


def claim(catalogue: Catalogue, **asked: int) -> Claim | None:
    return catalogue.claim_next("worker", 30.0, SOLVER, **asked)


def claimed(catalogue: Catalogue, count: int, **asked: int) -> list[str]:
    """Claim blocks and return their owners."""
    claims = [claim(catalogue, **asked) for _ in range(count)]
    return [one.job.owner for one in claims if one is not None]


@pytest.mark.parametrize("submitted", [submit, batch])
def test_a_thousand_jobs_delay_those_of_others_by_what_runs(
    catalogue: Catalogue, submitted: Callable[[Catalogue, str, int], object]
) -> None:
    batch(catalogue, "ada", 1000)
    assert claimed(catalogue, 2) == ["ada"] * 2
    submitted(catalogue, "bob", 1)
    assert claimed(catalogue, 1) == ["bob"]


def test_whoever_had_nothing_waiting_has_saved_up_nothing(catalogue: Catalogue) -> None:
    batch(catalogue, "ada", 20)
    claimed(catalogue, 10)
    batch(catalogue, "bob", 20)
    assert sorted(claimed(catalogue, 10)) == ["ada"] * 5 + ["bob"] * 5


def test_whoever_submits_one_after_the_other_gets_no_more_than_his_share(
    catalogue: Catalogue,
) -> None:
    for owner in OWNERS[:2]:
        batch(catalogue, owner, 20)
    found = []
    for _ in range(12):
        batch(catalogue, "eve", 1)
        found += claimed(catalogue, 1)
    assert found.count("eve") <= 5


def test_jobs_of_one_owner_and_of_nobody_come_as_they_were_submitted(catalogue: Catalogue) -> None:
    for owner in ("", "ada"):
        jobs = submit(catalogue, owner, 5)
        claims = [claim(catalogue) for _ in jobs]
        assert [one and one.job.id for one in claims] == jobs


def served(catalogue: Catalogue, clock: Clock, seconds: float) -> str:
    """Compute the block whose turn it is for so long, and return its owner."""
    held = claim(catalogue)
    assert held is not None
    clock.now += seconds
    catalogue.finish(held.block.id, 1, BlockEnd(BlockState.done))
    catalogue.settle()
    return held.job.owner


def test_jobs_that_come_alone_are_first_as_long_as_their_owner_is_little_ahead(
    catalogue: Catalogue, clock: Clock
) -> None:
    batch(catalogue, "bob", 50)
    owners = []
    for _ in range(100):  # there is always one of ada's
        submit(catalogue, "ada")
        owners.append(served(catalogue, clock, 5.0))
    lead, most = 0.0, 0.0
    for owner in owners:
        lead += 5.0 if owner == "ada" else -5.0
        most = max(most, lead)
    assert owners[:10] == ["ada"] * 10
    assert most <= HEAD_START + 2 * 5.0  # a block that runs, and what it was thought to cost
    assert owners[20:].count("bob") == 40


def test_one_owners_jobs_that_come_alone_are_before_his_studies(
    catalogue: Catalogue, clock: Clock
) -> None:
    batch(catalogue, "ada", 5)
    for _ in range(20):
        (alone,) = submit(catalogue, "ada")
        held = claim(catalogue)
        assert held is not None
        assert held.job.id == alone
        clock.now += 10.0
        catalogue.finish(held.block.id, 1, BlockEnd(BlockState.done))
        catalogue.settle()


def test_what_no_worker_may_take_saves_up_little(catalogue: Catalogue, clock: Clock) -> None:
    catalogue.submit_batch([replace(RUN, owner="ada", solver_version="other")], owner="ada")
    batch(catalogue, "bob", 200)
    for _ in range(50):
        assert served(catalogue, clock, 60.0) == "bob"
    batch(catalogue, "ada", 200)
    owners = [served(catalogue, clock, 60.0) for _ in range(40)]
    assert owners.count("ada") <= 1 + MOST_BEHIND / 60.0 + 40 / 2


@st.composite
def histories(draw: st.DrawFn) -> list[tuple[str, int]]:
    """Draw submissions by an owner, and claims by nobody, of so many blocks."""
    steps = st.tuples(st.sampled_from([*OWNERS, ""]), st.integers(1, 6))
    return draw(st.lists(steps, min_size=1, max_size=10))


@settings(
    max_examples=10, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(history=histories())
def test_no_owner_with_work_waiting_is_behind_by_more_than_a_job_of_each(
    new_url: Callable[[], str], history: list[tuple[str, int]]
) -> None:
    with closing(Catalogue(new_url(), clock=Clock())) as catalogue:
        waiting = dict.fromkeys(OWNERS, 0)
        gained = dict.fromkeys(combinations(OWNERS, 2), (0, 0, 0))  # lead, its least, its greatest
        for owner, count in [*history, ("", 200)]:
            if owner:
                batch(catalogue, owner, count)
                waiting[owner] += count
                continue
            for _ in range(min(count, sum(waiting.values()))):
                before = dict(waiting)
                (served,) = claimed(catalogue, 1)
                waiting[served] -= 1
                for pair, (lead, least, greatest) in gained.items():
                    if not all(before[one] for one in pair):
                        gained[pair] = (0, 0, 0)  # who had nothing waiting begins anew
                        continue
                    lead += (served == pair[0]) - (served == pair[1])
                    gained[pair] = lead, min(least, lead), max(greatest, lead)
                    assert gained[pair][2] - gained[pair][1] <= 2
        assert claim(catalogue) is None


@st.composite
def costs(draw: st.DrawFn) -> dict[str, list[float]]:
    """Draw what the blocks of each owner take, s, one after the other and again."""
    some = st.lists(st.sampled_from([0.01, 1.0, 3.0, 60.0, 600.0]), min_size=1, max_size=4)
    return {owner: draw(some) for owner in OWNERS}


@settings(
    max_examples=4, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(costs=costs(), workers=st.integers(1, 3), late=st.integers(0, 30))
def test_no_owner_with_work_waiting_gets_less_time_by_more_than_a_block_of_each_for_each_worker(
    new_url: Callable[[], str], costs: dict[str, list[float]], workers: int, late: int
) -> None:
    clock = Clock()
    with closing(Catalogue(new_url(), clock=clock)) as catalogue:
        seconds = {owner: cycle(some) for owner, some in costs.items()}
        gained = dict.fromkeys(combinations(OWNERS, 2), (0.0, 0.0, 0.0))
        waiting = set(OWNERS[:2])
        for owner in waiting:
            batch(catalogue, owner, 60)
        running: list[tuple[float, str]] = []
        for number in range(45):
            if number == late:  # after others have had much
                batch(catalogue, OWNERS[2], 60)
                waiting.add(OWNERS[2])
            if len(running) == workers:
                clock.now, block = heappop(running)
                catalogue.finish(block, 1, BlockEnd(BlockState.done))
                catalogue.settle()
            held = claim(catalogue)
            assert held is not None
            takes = next(seconds[held.job.owner])
            heappush(running, (clock.now + takes, held.block.id))
            for pair in combinations(sorted(waiting), 2):
                lead, least, greatest = gained[pair]
                lead += takes * ((held.job.owner == pair[0]) - (held.job.owner == pair[1]))
                gained[pair] = lead, min(least, lead), max(greatest, lead)
                allowed = workers * sum(max(costs[owner]) for owner in pair)
                assert gained[pair][2] - gained[pair][1] <= allowed + 1e-6


def test_whoever_has_long_blocks_has_fewer_turns(catalogue: Catalogue, clock: Clock) -> None:
    batch(catalogue, "ada", 5)
    batch(catalogue, "bob", 50)
    seconds = {"ada": 100.0, "bob": 10.0}
    owners = []
    for _ in range(33):
        held = claim(catalogue)
        assert held is not None
        owners.append(held.job.owner)
        clock.now += seconds[held.job.owner]
        catalogue.finish(held.block.id, 1, BlockEnd(BlockState.done))
        catalogue.settle()
    assert owners.count("ada") == 3


def test_what_was_given_back_counts_as_well(catalogue: Catalogue, clock: Clock) -> None:
    batch(catalogue, "ada", 3)
    batch(catalogue, "bob", 15)
    held = claim(catalogue)
    assert held is not None
    assert held.job.owner == "ada"
    clock.now += 10.0
    catalogue.release(held.block.id, 1)
    again = claim(catalogue)  # what was begun comes first
    assert again is not None
    assert again.job.id == held.job.id
    clock.now += 1.0
    catalogue.finish(again.block.id, 2, BlockEnd(BlockState.done))
    catalogue.settle()
    assert claimed(catalogue, 9) == ["bob"] * 9  # of a second, as it is thought


def test_owners_are_computed_at_most_so_many_blocks_at_a_time(catalogue: Catalogue) -> None:
    batch(catalogue, "ada", 5)
    batch(catalogue, "bob", 2)
    assert sorted(claimed(catalogue, 10, most_running=3)) == ["ada"] * 3 + ["bob"] * 2
    assert catalogue.due_wake_ups(10, 3) == ()
    running = next(job for job in catalogue.every_job() if job.started and job.owner == "ada")
    catalogue.finish(f"{running.id}-0", 1, BlockEnd(BlockState.done))
    assert [catalogue.get(one.block[:26]).owner for one in catalogue.due_wake_ups(10, 3)] == [
        "ada"
    ] * 2
    assert claimed(catalogue, 10, most_running=3) == ["ada"]
    submit(catalogue, "", 5)
    assert claimed(catalogue, 10, most_running=3) == [""] * 5
