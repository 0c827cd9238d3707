"""The instants at which companions are compared, and that companions hand out just these."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from jointplay.solver.kernels.loop.runs import SAMPLES, Status
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.runs.certificate.companions import LADDER, RUN, TWIN, Companions
from jointplay.solver.runs.certificate.instants import FIRST, Instants
from tests.solver.runs.test_determinism import PROBLEMS, bundle_of, preset


@pytest.mark.parametrize(("duration", "unit", "octaves"), [(1.0, 2.0, 0), (8.0, 1.0, 3), (9, 1, 4)])
def test_each_octave_has_half_as_many_as_the_first(
    duration: float, unit: float, octaves: int
) -> None:
    instants = Instants.over(duration, unit)
    time = instants.time
    assert instants.octaves == octaves
    assert len(time) == FIRST + 1 + octaves * FIRST // 2
    assert (time[0], time[-1]) == (0.0, duration)
    steps = np.diff(time)
    assert steps.min() == steps[0] == duration / (FIRST << octaves)
    assert (np.diff(steps) >= 0.0).all()
    later = time[1:] > time[FIRST]
    assert (steps[later] <= time[1:][later] / (FIRST / 2)).all()
    assert all(instants.index[i] % instants.stride(int(instants.index[i])) == 0 for i in range(9))


@given(st.floats(1.0, 1e9) | st.integers(1, 10**6).map(float), st.floats(1e-3, 1e3))
def test_late_instants_meet_all_phases_of_the_period(periods: float, period: float) -> None:
    instants = Instants.over(periods * period, period)
    assert not instants.misses_phases(period)
    assert FIRST <= instants.first <= 1.1 * FIRST
    assert instants.time[-1] == instants.duration
    assert (np.diff(instants.time) > 0.0).all()
    assert all(i % instants.stride(i) == 0 for i in map(int, instants.index))


def followed(budget: int) -> tuple[Bundle, Companions]:
    """Return a press over several of its short periods, and its companions at their ends."""
    problem = replace(PROBLEMS[4], duration=1.5, tolerance=1e-6)
    bundle = bundle_of([problem])
    companions = Companions.beside(bundle, problem)
    while bundle.runs["status"][RUN] == Status.RUNNING or companions.running:
        bundle.advance(companions.allowance(budget))
        companions.collect()
    return bundle, companions


def test_companions_hand_out_the_instants_however_the_run_is_sliced() -> None:
    bundle, companions = followed(10**6)
    assert companions.instants.octaves == 1
    _, sliced = followed(1700)
    period = bundle.runs["period"][RUN]
    for lane in companions.rows:
        rows = companions.dense(lane)
        assert rows.tobytes() == sliced.dense(lane).tobytes()
        # a row has its time as whole periods and the rest
        found = rows[:, 0] * period + rows[:, 1]
        np.testing.assert_allclose(found, companions.instants.time, atol=1e-12)


@pytest.mark.parametrize(
    ("problem", "duration"),
    [
        pytest.param(PROBLEMS[4], 1.5, id="open"),
        pytest.param(replace(PROBLEMS[4], scene=preset("double-four-bar")), 0.2, id="closed loop"),
    ],
)
def test_one_companion_is_the_trajectory_bit_for_bit(problem: LaneProblem, duration: float) -> None:
    period = float(bundle_of([problem]).lane(RUN).run["period"])
    step = Instants.over(duration, period).finest
    samples = round(duration / step) + 1
    same = replace(problem, duration=duration, output_step=step, samples=samples, tolerance=1e-6)
    bundle, problem = bundle_of([same]), same
    companions = Companions.beside(bundle, problem)
    handed_out = []
    while bundle.lane(RUN).running or companions.running:
        bundle.advance(companions.allowance(10**6))
        companions.collect()
        handed_out.append(bundle.rows(SAMPLES, RUN).copy())
    own = np.concatenate(handed_out)[companions.instants.index]
    assert companions.dense(TWIN).tobytes() == own.tobytes()


def test_longest_steps_differ_as_tolerances_do() -> None:
    bundle = followed(10**6)[0]
    longest = [bundle.lane(lane).number("largest_step") for lane in (RUN, *range(1, 5))]
    order = bundle.kernel.tableau.order
    assert np.divide(longest[1:], longest[0]) ** order == pytest.approx(LADDER)


def test_tighter_companions_take_more_steps_and_looser_ones_fewer() -> None:
    bundle = followed(10**6)[0]
    steps = [bundle.lane(lane).attempts for lane in (RUN, *range(1, len(LADDER) + 1))]
    # the ends of the ladder: neighbours differ less than their impacts do, soon not the same ones
    assert steps[1] > steps[0] > steps[-1]
    # fifth order: a quarter of the tolerance takes 4^0.2 = 1.32 times the steps, less where they
    # are at the limit of stability; soon the impacts are not the same ones, which is worth a sixth
    # of the steps either way
    assert 1.05 < steps[1] / steps[0] < 1.55
    assert (bundle.runs["status"] == Status.DONE).all()
