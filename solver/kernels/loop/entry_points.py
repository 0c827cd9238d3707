"""Entry points of the loop: its functions that Python calls, and the arrays that they take."""

from functools import partial

import numpy as np

from jointplay.records.impact import IMPACT
from jointplay.solver.kernels.emit import functions, slots
from jointplay.solver.kernels.entry_point import INTEGER, REAL, Array, EntryPoint, Structure
from jointplay.solver.kernels.loop import runs
from jointplay.solver.kernels.loop.extremes.search import brackets
from jointplay.solver.kernels.loop.runs import Buffers
from jointplay.solver.kernels.loop.workspace import Workspace
from jointplay.solver.kernels.loop_code import FOR_RUNS, FOR_WINDOWS, address_in

ADDRESSES = Array.of(functions.DTYPE, 1)
"""Addresses of the kernel's functions."""
AT = Array.of(slots.DTYPE, 1)
"""Where its quantities are."""
RUNS = Array.of(runs.DTYPE, 1)
"""Runs of lanes."""
TABLE = WORK = Array.of(np.float64, 2)
"""Rows of numbers; of all quantities, (slots, lanes)."""
INDICES = Array.of(np.int64, 1)
"""Steps of instants, or rows of the channel block."""
WORKSPACE = Structure(Workspace, (ADDRESSES, AT, WORK, WORK, RUNS, Array.of(brackets.DTYPE, 1)))
BUFFERS = Structure(
    Buffers,
    (
        Array.of(np.float64, 4),
        Array.of(IMPACT, 2),
        Array.of(runs.GROWTH, 2),
        Array.of(np.float64, 3),
    ),
)
_run, _window = (partial(address_in, part) for part in (FOR_RUNS, FOR_WINDOWS))

advance = EntryPoint("advance", _run, (WORKSPACE, BUFFERS, INTEGER, INTEGER), INTEGER)
observe_rows = EntryPoint(
    "observe_rows", _run, (ADDRESSES, AT, WORK, WORK, INTEGER, TABLE, INDICES, TABLE)
)
set_clocks = EntryPoint("set_clocks", _run, (AT, WORK, RUNS))
plan_anew = EntryPoint("plan_anew", _run, (AT, WORK, RUNS, INTEGER))
start_tangents = EntryPoint("start_tangents", _run, (AT, WORK))
measure_tangent = EntryPoint("measure_tangent", _run, (AT, WORK, INTEGER), REAL)

find_steps = EntryPoint("find_steps", _window, (RUNS, TABLE, TABLE, INDICES))
states_in_steps = EntryPoint("states_in_steps", _window, (WORKSPACE, TABLE, TABLE, INDICES, TABLE))
make_again = EntryPoint("make_again", _window, (WORKSPACE, TABLE, TABLE, TABLE))
extremes_in_steps = EntryPoint(
    "extremes_in_steps",
    _window,
    (WORKSPACE, TABLE, Array.of(np.int64, 2), TABLE, INDICES, REAL, TABLE, Array.of(np.float64, 3)),
)
