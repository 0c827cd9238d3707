"""Slots that loops find by name: slots, functions and columns of dense rows."""

from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from jointplay.solver.integrators import METHODS
from jointplay.solver.kernels.emit.functions import SIGNATURES, addresses_of
from jointplay.solver.kernels.emit.kernel import Kernel, compile_kernel
from jointplay.solver.kernels.emit.slots import (
    DERIVED,
    NAMES,
    OF_TANGENTS,
    PERIOD,
    SLOTS,
    TIME,
    DenseRow,
    StepRow,
    slots_of,
)
from jointplay.solver.kernels.emit.tangents import compile_tangents
from jointplay.solver.kernels.layout import Layout
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem, LaneStart
from jointplay.solver.mechanics.tree import spanning_tree
from tests.solver.readable_mechanics import preset

COUNTS = {"states": 6, "inner_states": 0, "ledger": 3, "pairs": 1, "clocks": 0, "rows": 5}
COUNTS |= {"watched_closely": 0}


def kernel_of(name: str) -> Kernel:
    scene = preset(name)
    return compile_kernel(scene, spanning_tree(scene), "reduced", METHODS["tsitouras"])


def layout_without(missing: str) -> Layout:
    layout = Layout()
    for name in (*SLOTS, "ledger"):
        if name != missing:
            layout.add_block(name, 3)
    return layout


@pytest.mark.parametrize("missing", SLOTS)
def test_a_slot_that_the_layout_lacks_is_an_error(missing: str) -> None:
    rows = DenseRow.of(0, 6, 1), StepRow.of(3, 6, 1)
    slots_of(layout_without(""), *rows, COUNTS)
    with pytest.raises(KeyError, match=missing):
        slots_of(layout_without(missing), *rows, COUNTS)


def test_every_block_is_where_the_layout_has_it_even_if_it_is_empty() -> None:
    kernel = kernel_of("pendulum")
    assert not kernel.pairs
    for name in SLOTS:
        assert kernel.slots[name][0] == kernel.layout.block(name).start
    tangents = compile_tangents(kernel)
    for name in OF_TANGENTS:
        assert tangents.slots[name][0] == tangents.layout.block(name).start
    assert set(NAMES) == {*SLOTS, *OF_TANGENTS, *COUNTS, *DERIVED}


def test_a_name_is_given_to_one_slot() -> None:
    layout = Layout()
    layout.add("penetration")
    layout.add_block("mode", 2)
    assert (layout.block("penetration"), layout.block("mode")) == (slice(0, 1), slice(1, 3))
    for name in ("penetration", "mode"):
        with pytest.raises(KeyError, match=name):
            layout.add(name)
        with pytest.raises(KeyError, match=name):
            layout.add_block(name, 1)


def swapped(module: Any, one: str, other: str) -> Any:
    functions = {name: getattr(module, name) for name in SIGNATURES if hasattr(module, name)}
    return SimpleNamespace(**(functions | {one: functions[other]}))


def test_a_function_of_another_kind_is_not_taken_and_none_may_be_missing() -> None:
    kernel = kernel_of("bouncing-journal")
    module = cast(Any, kernel.module)
    for one, other in (("attempt", "take"), ("scan", "take"), ("states_within", "observe")):
        with pytest.raises(TypeError, match=f"'{other}' is"):
            addresses_of(swapped(module, one, other))
    lacking = swapped(module, "take", "take")
    del lacking.take
    with pytest.raises(TypeError, match="no function 'take'"):
        addresses_of(lacking)
    assert kernel.addresses["tangent_step"][0] == 0
    given = compile_tangents(kernel).addresses
    assert len({int(given[name][0]) for name in SIGNATURES}) == len(SIGNATURES)


@given(drivers=st.integers(0, 3), states=st.integers(1, 9), joints=st.integers(0, 4))
def test_a_dense_row_is_read_as_it_was_written(drivers: int, states: int, joints: int) -> None:
    columns = DenseRow.of(drivers, states, joints)
    row = np.arange(columns.width, dtype=float)
    parts = [
        row[columns.phase : columns.wound],
        row[columns.wound : columns.state],
        columns.states(row),
        row[columns.mode : columns.impact_rate],
        row[columns.impact_rate :],
    ]
    assert [len(part) for part in parts] == [drivers, drivers, states, joints, joints]
    assert np.array_equal(np.concatenate([row[[PERIOD, TIME]], *parts]), row)
    start = LaneStart.at_row(row, columns)
    assert (start.period, start.time) == (row[PERIOD], row[TIME])
    assert start.contact is not None
    assert np.array_equal(start.state, parts[2])
    assert len(start.contact) == joints


def test_a_lane_goes_on_from_its_own_row_where_it_was() -> None:
    scene, kernel = preset("bouncing-journal"), kernel_of("bouncing-journal")
    problem = LaneProblem(scene, 0.3, 1e-8, 0.3, 2, 0, 0.0)
    bundle = Bundle(kernel, [problem])
    bundle.advance(400)
    lane = bundle.lane(0)
    (row,) = lane.row()
    start = LaneStart.at_row(row, kernel.row)
    again = Bundle(kernel, [LaneProblem(scene, 0.3, 1e-8, 0.3, 2, 0, 0.0, start=start)]).lane(0)
    for name in ("y", "time", "mode", "impact_rate", "k1_", "phase"):
        assert again[name].tobytes() == lane[name].tobytes(), name
