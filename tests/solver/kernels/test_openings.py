"""Openings of gaps: where a cubic falls to zero, and what a step sees of them."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numba import carray, cfunc, types

from jointplay.solver.integrators import METHODS
from jointplay.solver.kernels.emit.enclosure import may_open
from jointplay.solver.kernels.emit.functions import DTYPE as FUNCTIONS
from jointplay.solver.kernels.emit.judging import RELEASE
from jointplay.solver.kernels.emit.kernel import compile_kernel
from jointplay.solver.kernels.emit.slots import DTYPE
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.openings import dip, falling_root
from jointplay.solver.kernels.loop.runs import DTYPE as RUN
from jointplay.solver.kernels.loop.step import Step
from jointplay.solver.kernels.target import own_target
from jointplay.solver.lanes.lane import aligned_zeros
from jointplay.solver.mechanics.tree import spanning_tree
from tests.solver.readable_mechanics import preset

LANES = own_target().lanes

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


NUMBERS = types.CPointer(types.float64)


@cfunc(types.void(NUMBERS, NUMBERS, types.int64))  # type: ignore[misc]
def penetrations_of_a_polynomial(lanes: Any, instants: Any, lane: int) -> None:
    """A gap with up to four zeros in a step, and its rate: it is as deep as their product."""
    work, spare = carray(lanes, (10, LANES)), carray(instants, (3, INSTANTS))
    for i in range(INSTANTS):
        share, depth, rate = spare[0, i], 1.0, 0.0
        for k in range(4):
            zero = work[3 + k, lane]
            rate = rate * (share - zero) + depth
            depth *= share - zero
        spare[1, i], spare[2, i] = depth, rate


def step_with_penetration(zeros: tuple[float, ...], start: tuple[float, float]) -> Step:
    """Return a step of lane 3 whose gap has these zeros, and its gap and rate at the start."""
    slots, addresses = np.zeros(1, DTYPE), np.zeros(1, FUNCTIONS)
    for slot, name in enumerate(("theta", "penetration", "penetration_rate")):
        slots[name] = slot
    for slot, name in enumerate(("penetration_start", "penetration_rate_start", "tried"), start=7):
        slots[name] = slot
    addresses["penetrations_within"] = penetrations_of_a_polynomial.address
    work, spare = np.zeros((10, LANES)), np.zeros((3, INSTANTS))
    work[3:7, 3], work[7:, 3] = zeros, (*start, 1.0)
    run = np.zeros(1, RUN)[0]
    return Step(3, run, slots[0], work, spare, np.zeros(0), addresses[0])


@pytest.mark.parametrize(
    ("zeros", "share"),
    [
        ((0.6, 0.9, -1.0, -1.0), 5.0 / 8.0),
        ((0.3, 0.302, -1.0, -1.0), 0.301),  # between two of the eighths
        ((0.991, 0.993, -1.0, -1.0), 0.992),
        ((0.1, 0.101, 0.7, 0.702), 0.1005),  # the first of two
        ((0.2, 0.7, 0.8, 2.0), 2.0 / 8.0),  # and open at the end, for good
        ((0.7, 2.0, -1.0, -1.0), 1.0),  # open at the end, once
        ((2.0, 2.0, -1.0, -1.0), 1.0),
    ],
)
def test_a_penetration_that_opens_and_closes_inside_a_step_is_found(
    zeros: tuple[float, ...], share: float
) -> None:
    rate = -sum(math.prod(zeros[:k] + zeros[k + 1 :]) for k in range(len(zeros)))
    found = dip(0, step_with_penetration(zeros, (math.prod(zeros), rate)))
    assert found == pytest.approx(share, abs=1.1e-3)


def test_a_contact_that_has_just_begun_must_have_been_deeper_before_it_opens() -> None:
    # it rises where it is positive: 0.4 to 0.6 is closed
    assert dip(0, step_with_penetration((0.0, 0.4, 0.6, 2.0), (0.0, -0.48))) == 1.0
    assert dip(0, step_with_penetration((0.0, 0.4, 0.6, -2.0), (0.0, 0.48))) == 4.0 / 8.0


@pytest.mark.parametrize(
    ("start", "start_rate", "end", "end_rate", "opens"),
    [
        (1e-6, -1.0, 1e-6, 1.0, True),  # 1.5e-6 m open in between
        (1e-6, -0.1, 1e-6, 0.1, False),  # closed all the time
        (1e-6, 0.1, 1e-6, 0.1, False),  # it turns twice, but hardly
        (1e-6, 1.0, 1e-6, 1.0, True),  # far enough to open
        (1e-6, -1.0, -1e-7, 0.1, True),  # on its way back already
        (-1e-14, 1.0, 1e-6, 1.0, True),  # just landed: one line parts it from no disc
        (1e-6, -1.0, -1e-6, -1.0, True),
    ],
)
def test_a_step_in_contact_asks_for_a_look_where_its_penetration_may_have_opened(
    start: float, start_rate: float, end: float, end_rate: float, opens: bool
) -> None:
    scene = preset("bouncing-journal")
    kernel = compile_kernel(scene, spanning_tree(scene), "reduced", METHODS["tsitouras"])
    work = aligned_zeros(kernel.layout.size, LANES)
    clearance = 1e-4
    for name, value in {
        "outer0": clearance, "eccentricity_start0": clearance + start,
        "eccentricity_start2": start_rate, "eccentricity0": clearance + end,
        "eccentricity2": end_rate,
        "active": 1.0, "tried": 1e-5, "step": 1e-5, "fastest": 1.0, "full": 1.0, "mode0": 1.0,
        "next_due": 1.0, "pace_at": 1e9,
        "penetration_start0": start, "penetration_rate_start0": start_rate,
        "penetration0": end, "penetration_rate0": end_rate,
    }.items():  # fmt: skip
        work[kernel.layout[name]] = value
    assert kernel.module.judge(work) == ((1 << LANES) - 1 if opens else 0)
    assert (work[kernel.layout["flag"]] == (RELEASE if opens else 0.0)).all()


numbers = st.lists(st.floats(-1.0, 1.0), min_size=12, max_size=12)


@given(numbers=numbers, size=st.floats(1e-9, 1.0), outer=st.floats(0.5, 1.1))
def test_a_path_that_surely_stays_beyond_a_circle_does(
    numbers: list[float], size: float, outer: float
) -> None:
    """Paths that leave (1, 0) for a place beside it, and curve on their way."""
    parts = size * np.array(numbers)
    slots = {f"eccentricity_start{i}": float(part) for i, part in enumerate(parts[:6])}
    slots |= {f"eccentricity{i}": float(part) for i, part in enumerate(parts[6:])}
    for name in ("eccentricity_start0", "eccentricity0"):
        slots[name] += 1.0
    slots |= {"tried": 1.0, "outer0": outer}
    if may_open(slots.__getitem__, 0, 0.0, "circle") > 0.0:
        return
    powers = np.linspace(0.0, 1.0, 1001)[:, None] ** np.arange(6)
    radii = np.hypot(*(powers @ quintic(slots, axis) for axis in range(2)))
    assert radii.min() >= outer * (1.0 - 1e-12)


def quintic(slots: dict[str, float], axis: int) -> np.ndarray:
    """Return the coefficients of the polynomial of least degree that fits both ends."""
    rows, values = [], []
    for block, at in (("eccentricity_start", 0.0), ("eccentricity", 1.0)):
        for order in range(3):
            factors = [math.perm(k, order) * (at ** max(k - order, 0)) for k in range(6)]
            rows.append(factors)
            values.append(slots[f"{block}{axis + 2 * order}"])
    return np.linalg.solve(np.array(rows), np.array(values))
