"""Steps end at knots: of clocks, of positions, and where a force that acts one way sets in."""

from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicHermiteSpline

from jointplay.solver.kernels.emit.knots import AT_END
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kinds import admit
from jointplay.solver.runs import budget as slice_budget
from jointplay.solver.runs.dense_output.replay import Replay
from jointplay.solver.runs.simulate import Simulation
from tests.solver.completed_runs import Run, collect
from tests.solver.driven_motions import function
from tests.solver.knotted_scene import (
    FULL_RATE,
    JERKED,
    PUSH,
    STIFFNESS,
    WELLS,
    knotted_scene,
)

DURATION = 0.6


def simulation(**changes: Any) -> Simulation:
    job = {"kind": "simulate", "scene": knotted_scene(), "duration": DURATION}
    job |= {"method": "tsitouras", "tolerance": 1e-5, "certificate": False}
    return Simulation(admit(job | {"output_step": DURATION / 50} | changes))


@cache
def completed() -> tuple[Run, np.ndarray, np.ndarray]:
    """Return a run, when its steps begin and end, s, and the ball's position and speed there."""
    running = simulation()
    slices = list(running.slices())
    steps = np.concatenate([piece.steps[:, :-1] for piece in slices])
    replay = Replay(running.admission, "tsitouras")
    times = np.column_stack([replay.begins(steps), replay.ends(steps)])
    kernel = ready_kernel(running.admission.scene, "reduced", "tsitouras")
    first = kernel.step_row.state + kernel.coordinates.index("ball.s")
    ball = steps[:, [first, first + len(kernel.coordinates)]]
    return collect(running.admission, slices, running), times, ball


def test_a_force_that_is_cubic_between_knots_of_time_is_integrated_exactly() -> None:
    slopes = [function(PUSH).at(knot).slope for knot in PUSH["knots"]]
    force = CubicHermiteSpline(PUSH["knots"], PUSH["values"], slopes)
    way, last = force.antiderivative(2), PUSH["knots"][-1]
    expected = way(last) + way(last, 1) * (DURATION - last)
    # the method is exact for polynomials of degree five; the carrier's acceleration jumps by
    # 10 m/s^2 within steps of 3e-12 s, worth 1e-11 m. A knot inside a step would be worth 1e-7 m
    assert completed()[0].last("block.x")[0] == pytest.approx(expected, abs=2e-11)


def test_every_knot_of_a_clock_is_the_end_of_a_step() -> None:
    ends = completed()[1][:, 1]
    for knot in {*PUSH["knots"][1:], *JERKED["knots"][1:]}:
        assert np.min(np.abs(ends - knot)) <= 1e-11  # a jump is passed 2e-12 s before and behind


def test_no_step_passes_a_knot_of_a_position_or_of_a_rate() -> None:
    position, speed = completed()[2].T
    passed = 0
    for motion, knots in ((position, WELLS["knots"]), (speed, (0.0, FULL_RATE))):
        for begun, ended in pairwise(motion):
            near = AT_END * abs(ended - begun) + 1e-15  # of rounding
            low, high = min(begun, ended), max(begun, ended)
            passed += any(low <= knot <= high for knot in knots)
            assert not any(low + near < knot < high - near for knot in knots)
    assert passed >= 6


def test_a_force_of_position_that_acts_one_way_moves_a_ball_as_its_equation_says() -> None:
    wells = function(WELLS)

    def slope(_time: float, state: np.ndarray) -> list[float]:
        x, v = state
        share = min(max(v / FULL_RATE, 0.0), 1.0)
        kick = share * share * (3.0 - 2.0 * share)
        return [v, float(wells.at(float(x)).value) + kick - STIFFNESS * x]

    found = completed()[0]
    way = solve_ivp(
        slope, (0.0, DURATION), [0.0, 1.0], "DOP853", found.time, rtol=1e-12, atol=1e-13
    )
    # SciPy's own error, of steps over knots, is 1e-9 m; those of the samples here are of order four
    assert np.max(np.abs(found["ball.x"] - way.y[0])) <= 1e-8


def test_slices_and_checkpoints_at_knots_change_no_bit(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("FIRST", "LARGEST"):
        monkeypatch.setattr(slice_budget, name, 17)
    running = simulation()
    slices = []
    while True:
        found = next(running.slices(), None)
        if found is None:
            break
        slices.append(found)
        running = simulation_from(running.checkpoint())
    assert len(slices) > 10
    again, whole = collect(running.admission, slices, running), completed()[0]
    for name, values in whole.samples.items():
        assert values.tobytes() == again.samples[name].tobytes(), name
    assert whole.peaks == again.peaks


def simulation_from(checkpoint: bytes) -> Simulation:
    return Simulation(simulation().admission, checkpoint)
