"""The schedule of faults: repeatable, complete, and no longer than the campaign allows."""

from itertools import islice

import pytest

from jointplay.chaos.faults import FAULTS
from jointplay.chaos.jobs import jobs_of
from jointplay.chaos.schedule import schedule
from jointplay.job_fields import KINDS
from jointplay.solver.kinds import admit


def test_a_seed_repeats_its_schedule_and_another_has_another() -> None:
    first, again, other = (list(islice(schedule(n, 600.0, FAULTS), 50)) for n in (1, 1, 2))
    assert first == again
    assert first != other


@pytest.mark.parametrize("seed", range(5))
def test_every_fault_comes_before_any_comes_again(seed: int) -> None:
    strikes = list(islice(schedule(seed, 600.0, FAULTS), 2 * len(FAULTS)))
    for half in (strikes[: len(FAULTS)], strikes[len(FAULTS) :]):
        assert {strike.fault for strike in half} == FAULTS.keys()


def test_no_fault_takes_a_short_campaign_for_itself() -> None:
    for strike in islice(schedule(0, 120.0, FAULTS), 200):
        shortest, longest = FAULTS[strike.fault].lasts
        assert shortest <= strike.lasts <= max(shortest, min(longest, 20.0))


def test_the_mix_has_every_kind_and_every_job_of_it_is_admitted() -> None:
    mix = jobs_of(3)
    assert {job["kind"] for job in mix} == KINDS.keys()
    assert mix == jobs_of(3)
    assert mix != jobs_of(4)
    for job in mix:
        admit(dict(job))
