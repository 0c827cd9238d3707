"""Openings of gaps: where a cubic falls to zero, and what a step sees of them."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numba import njit

from jointplay.solver.integrators import METHODS
from jointplay.solver.kernels.emit.judging import RELEASE
from jointplay.solver.kernels.emit.kernel import compile_kernel
from jointplay.solver.kernels.emit.places import DTYPE
from jointplay.solver.kernels.lanes import LANES
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.bundle import aligned_zeros
from jointplay.solver.kernels.loop.openings import dip, falling_root
from jointplay.solver.mechanics.tree import spanning_tree
from tests.solver.readable_mechanics import preset

depths = st.floats(1e-12, 1.0)
rates = st.floats(-10.0, 10.0)


@given(start=depths, end=st.floats(-1.0, 0.0), start_rate=rates, end_rate=rates)
def test_the_cubic_changes_its_sign_at_the_root(
    start: float, end: float, start_rate: float, end_rate: float
) -> None:
    def cubic(x: float) -> float:
        rest = 1.0 - x
        left = (1.0 + 2.0 * x) * start + x * start_rate
        right = (3.0 - 2.0 * x) * end - rest * end_rate
        return rest * rest * left + x * x * right

    root = falling_root(start, start_rate, end, end_rate)
    assert 0.0 <= root <= 1.0
    # at a double root Newton's steps only halve: forty of them come to 1e-12 of the interval
    size = max(start, -end, abs(start_rate), abs(end_rate))
    assert cubic(root) == pytest.approx(0.0, abs=1e-11 * size)


@given(start=depths, speed=st.floats(1.0, 1e3))
def test_a_straight_line_is_met_at_once(start: float, speed: float) -> None:
    rate = -start * speed
    end = start + rate
    assert falling_root(start, rate, min(end, 0.0), rate) == pytest.approx(1.0 / speed, rel=1e-12)


@njit
def gaps_of_a_parabola(work: np.ndarray, spare: np.ndarray, lane: int) -> None:
    """Gaps below zero in the second half of a step, but not at its end."""
    for i in range(INSTANTS):
        share = spare[0, i]
        spare[1, i] = (share - 0.6) * (share - 0.9)


@njit
def no_gaps(work: np.ndarray, spare: np.ndarray, lane: int) -> None:
    for i in range(INSTANTS):
        spare[1, i] = 1.0


def test_a_gap_that_opens_and_closes_inside_a_step_is_found() -> None:
    places = np.zeros(1, DTYPE)
    places["theta"], places["gap"] = 0, 1
    work, spare = np.zeros((2, LANES)), np.zeros((2, INSTANTS))
    assert dip(0, 3, places[0], work, spare, gaps_of_a_parabola) == 5.0 / 8.0
    assert dip(0, 3, places[0], work, spare, no_gaps) == 1.0


@pytest.mark.parametrize(
    ("start", "start_rate", "end", "end_rate", "opens"),
    [
        (1e-6, -1.0, 1e-6, 1.0, True),  # 1.5e-6 m open in between
        (1e-6, -0.1, 1e-6, 0.1, False),  # closed all the time
        (1e-6, -1.0, -1e-7, 0.1, True),  # on its way back already
        (-1e-14, 1.0, 1e-6, 1.0, False),  # just landed
        (1e-6, -1.0, -1e-6, -1.0, True),
    ],
)
def test_a_step_in_contact_asks_for_a_look_where_its_gap_may_have_opened(
    start: float, start_rate: float, end: float, end_rate: float, opens: bool
) -> None:
    scene = preset("bouncing-journal")
    kernel = compile_kernel(scene, spanning_tree(scene), "reduced", METHODS["tsitouras"])
    work = aligned_zeros(kernel.layout.size, LANES)
    for name, value in {
        "active": 1.0, "tried": 1e-5, "step": 1e-5, "fastest": 1.0, "full": 1.0, "mode0": 1.0,
        "next_due": 1.0, "pace_at": 1e9, "gap_start0": start, "gap_rate_start0": start_rate,
        "gap0": end, "gap_rate0": end_rate,
    }.items():  # fmt: skip
        work[kernel.layout[name]] = value
    assert kernel.module.judge(work) == (RELEASE if opens else 0.0)
