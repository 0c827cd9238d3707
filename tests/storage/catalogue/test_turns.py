"""Owners whose work waits in one queue are served alike, however much each has submitted."""

from collections.abc import Callable
from contextlib import closing
from dataclasses import replace
from itertools import combinations

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from stepped_clock import Clock

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import BlockState, Claim, NewJob, Solver

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


def test_wake_ups_are_sent_in_turn(catalogue: Catalogue) -> None:
    batch(catalogue, "ada", 5)
    batch(catalogue, "bob", 5)
    owners = [catalogue.get(one.block[:26]).owner for one in catalogue.due_wake_ups(4)]
    assert sorted(owners) == ["ada"] * 2 + ["bob"] * 2


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


def test_owners_are_computed_at_most_so_many_blocks_at_a_time(catalogue: Catalogue) -> None:
    batch(catalogue, "ada", 5)
    batch(catalogue, "bob", 2)
    assert sorted(claimed(catalogue, 10, most_running=3)) == ["ada"] * 3 + ["bob"] * 2
    assert catalogue.due_wake_ups(10, 3) == ()
    running = next(job for job in catalogue.every_job() if job.started and job.owner == "ada")
    catalogue.finish(f"{running.id}-0", 1, BlockState.done)
    assert [catalogue.get(one.block[:26]).owner for one in catalogue.due_wake_ups(10, 3)] == [
        "ada"
    ] * 2
    assert claimed(catalogue, 10, most_running=3) == ["ada"]
    submit(catalogue, "", 5)
    assert claimed(catalogue, 10, most_running=3) == [""] * 5
