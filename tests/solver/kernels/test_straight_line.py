"""Tapes: every statement and operation over eight lanes, against the same on floats."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from jointplay.solver.kernels.emit.emit import Tape
from jointplay.solver.kernels.emit.module import load
from jointplay.solver.kernels.emit.tapes import Source
from jointplay.solver.kernels.layout import INSTANTS, Layout
from jointplay.solver.kernels.target import own_target
from jointplay.solver.kernels.trace.operations import OPERATIONS
from jointplay.solver.kernels.trace.tracer import Tracer

LANES = own_target().lanes

SLOTS = 24
POSITIVE = {"sqrt", "exponent_of", "mantissa_of"}
ON_LANES = {name for name, one in OPERATIONS.items() if one.on_lanes}
EVERY_OPERATION = dict.fromkeys(ON_LANES, 1) | {
    "add": 2,
    "sub": 2,
    "mul": 2,
    "div": 2,
    "select": 3,
    "quarter_turns": 3,
}
"""Number of operands that each has."""


def compiled(tape, over="lanes", rows=0):
    """Return what a tape does to W, to W, S and a lane, or to W and a row."""
    return load([Source("run", tuple(tape.strip().splitlines()), over, rows)]).run


RUNS = {
    operation: compiled(
        "\n".join(
            [f"v{i} = load {i}" for i in range(count)]
            + [f"v9 = {operation} " + " ".join(f"v{i}" for i in range(count)), "store 9 v9"]
        )
    )
    for operation, count in EVERY_OPERATION.items()
}


RETURNING = compiled("v0 = load 1\nreturn v0")


@pytest.mark.parametrize("operation", sorted(ON_LANES))
@given(numbers=st.lists(st.floats(-1e3, 1e3), min_size=3 * LANES, max_size=3 * LANES))
def test_every_operation_does_in_each_lane_what_it_does_to_floats(
    operation: str, numbers: list[float]
) -> None:
    count = EVERY_OPERATION[operation]
    operands = np.array(numbers).reshape(3, LANES)
    if operation in POSITIVE:
        operands = np.abs(operands) + 1e-3
    if operation == "div":
        operands[1] += np.where(operands[1] < 0.0, -1e-3, 1e-3)
    if operation in ("power_of_two", "quarter_turns"):
        operands = np.floor(operands)
    work = np.zeros((SLOTS, LANES))
    work[:3] = operands
    RUNS[operation](work)
    on_floats = OPERATIONS[operation].on_floats
    expected = [on_floats(*map(float, operands[:count, lane])) for lane in range(LANES)]
    assert work[9].tolist() == expected


def test_a_select_between_what_is_compared_takes_the_second_where_there_is_no_number() -> None:
    run = compiled("v0 = load 0\nv1 = load 1\nv2 = sub v0 v1\nv3 = select v2 v0 v1\nstore 2 v3")
    work = np.zeros((SLOTS, LANES))
    work[0, :4], work[1, :4] = [1.0, 3.0, math.nan, math.inf], [2.0, 2.0, 5.0, math.inf]
    run(work)
    assert work[2, :4].tolist() == [2.0, 3.0, 5.0, math.inf]


@given(numbers=st.lists(st.floats(-1.0, 1.0), min_size=LANES, max_size=LANES))
def test_the_lanes_that_are_positive_are_returned(numbers: list[float]) -> None:
    work = np.zeros((SLOTS, LANES))
    work[1] = numbers
    assert RETURNING(work) == sum(1 << lane for lane in range(LANES) if numbers[lane] > 0.0)


def test_one_lane_is_seen_from_all() -> None:
    tape = """
v0 = spread 1
v1 = spread 2 3
v2 = given 4
v3 = add v1 v2
store 5 v0
store 6 v3
"""
    run = compiled(tape, "instants")
    work = np.arange(SLOTS * LANES, dtype=float).reshape(SLOTS, LANES)
    spare = np.zeros((SLOTS, INSTANTS))
    shares = 1000.0 * np.arange(INSTANTS)
    spare[4] = shares
    for lane in range(LANES):
        run(work, spare, lane)
        assert spare[5].tolist() == [work[1, lane]] * INSTANTS
        steps = np.array([work[2, lane]] * 4 + [work[3, lane]] * 4)
        assert spare[6].tolist() == (steps + shares).tolist()


@given(numbers=st.lists(st.floats(-1.0, 1.0), min_size=5 * LANES, max_size=5 * LANES))
def test_rows_mark_the_lanes_that_are_positive(numbers: list[float]) -> None:
    work = np.zeros((SLOTS, LANES))
    work[8:13] = np.array(numbers).reshape(5, LANES)
    found = ROWS(work)
    marked = work[1].view(np.uint8)[:5]
    for row in range(5):
        assert marked[row] == sum(1 << lane for lane in range(LANES) if work[8 + row, lane] > 0.0)
    assert found == np.bitwise_or.reduce(marked)
    assert np.array_equal(work[16:21], 2.0 * work[8:13])


SOME_ROWS = compiled(
    "v0 = load 8+\nmark 1 0.0\nv1 = sub v0 0.5\nwhere v1\nmark 1 v0\nstore 16+ v0", "rows", 5
)
ROWS = compiled("v0 = load 8+\nv1 = mul 2.0 v0\nmark 1 v0\nstore 16+ v1", "rows", 5)


def test_a_tape_evaluates_what_slots_held_before_any_is_stored() -> None:
    layout, tracer = Layout(), Tracer()
    layout.add("one", "other", "sum")
    one, other = tracer.variable("one"), tracer.variable("other")
    tape = Tape(layout)
    tape.store([("one", other), ("other", one), ("sum", one + other)])
    run = compiled("\n".join(tape.lines))
    work = np.zeros((SLOTS, LANES))
    work[0], work[1] = 2.0, 5.0
    run(work)
    assert work[:3, 0].tolist() == [5.0, 2.0, 7.0]


def test_a_tape_for_one_row_moves_its_slots() -> None:
    moved = compiled("v0 = load 2\nv1 = load 4+\nv2 = add v0 v1\nstore 8+ v2", "row")
    work = np.arange(SLOTS * LANES, dtype=float).reshape(SLOTS, LANES)
    expected = work[2] + work[7]
    moved(work, 3)
    assert work[11].tolist() == expected.tolist()


@given(numbers=st.lists(st.floats(-1.0, 1.0), min_size=5 * LANES, max_size=5 * LANES))
def test_what_follows_is_done_in_rows_where_a_lane_says_so(numbers: list[float]) -> None:
    work = np.zeros((SLOTS, LANES))
    work[8:13] = np.array(numbers).reshape(5, LANES)
    found = SOME_ROWS(work)
    for row in range(5):
        wanted = (work[8 + row] > 0.5).any()
        marked = sum(1 << k for k in range(LANES) if work[8 + row, k] > 0.0) if wanted else 0
        assert work[1].view(np.uint8)[row] == marked
        assert np.array_equal(work[16 + row], work[8 + row] if wanted else np.zeros(LANES))
    assert found == np.bitwise_or.reduce(work[1].view(np.uint8)[:5])
