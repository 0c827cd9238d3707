"""The loop for one lane alone: what a thread of a device does in a launch."""

# mypy: disable-error-code="no-untyped-call,attr-defined"

from typing import Any, NamedTuple

from numba import carray, from_dtype, int64, types, void

from jointplay.records.impact import IMPACT
from jointplay.solver.kernels.device.lanes import Sizes
from jointplay.solver.kernels.emit import functions, slots
from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop import generated, runs
from jointplay.solver.kernels.loop.lanes import attend_lanes, landing_lanes, settle_lanes
from jointplay.solver.kernels.loop.runs import Buffers
from jointplay.solver.kernels.loop.step import Group
from jointplay.solver.kernels.loop.unowned_view import unowned


class GlobalMemory(NamedTuple):
    """Addresses of what all lanes have, one behind the other."""

    columns: Any
    """All quantities, (slots, lanes): threads side by side read numbers side by side."""
    runs: Any
    rows: Any
    """Samples and sections, (lanes, 2, rows, width)."""
    impacts: Any
    """(lanes, impacts)."""
    growths: Any
    """(lanes, growths)."""
    made: Any
    """Attempts in this launch."""


class LocalMemory(NamedTuple):
    """Addresses of a thread's own memory."""

    work: Any
    spare: Any
    run: Any


_NUMBERS, _RUN = types.CPointer(types.float64), types.CPointer(from_dtype(runs.DTYPE))
SIGNATURE = void(
    types.CPointer(from_dtype(functions.DTYPE)),
    types.CPointer(from_dtype(slots.DTYPE)),
    types.NamedTuple(
        [
            _NUMBERS,
            _RUN,
            _NUMBERS,
            types.CPointer(from_dtype(IMPACT)),
            types.CPointer(from_dtype(runs.GROWTH)),
            types.CPointer(types.int64),
        ],
        GlobalMemory,
    ),
    types.NamedTuple([_NUMBERS, _NUMBERS, _RUN], LocalMemory),
    types.NamedUniTuple(int64, len(Sizes._fields), Sizes),
    int64,
    int64,
)


@inner_kernel()
def advance_one_lane(
    addresses: Any,
    slots: Any,
    lanes: GlobalMemory,
    room: LocalMemory,
    sizes: Sizes,
    lane: int,
    budget: int,
) -> None:
    """Make at most `budget` attempts at a step, as `loop.advance` does for lanes side by side.

    Fewer where the lane ends or a buffer is full; buffers are empty at the beginning. Neither
    extremes nor crossings are sought, and no steps are kept. Numbers are copied into the thread's
    own memory, which is faster, and back.

    Parameters
    ----------
    addresses, slots
        Of the kernel's functions, and where quantities are, as `advance` takes them.
    lane
        Column of the lane.
    """
    work = unowned(carray(room.work, (sizes.slots, 1)))
    own, run = unowned(carray(room.run, (1,))), carray(lanes.runs, (sizes.lanes,))[lane]
    own[0] = run
    own[0].filled[0] = own[0].filled[1] = own[0].impacts = own[0].growths = 0
    for slot in range(sizes.slots):
        work[slot, 0] = lanes.columns[slot * sizes.lanes + lane]
    at, functions = carray(slots, (1,))[0], carray(addresses, (1,))[0]
    rows = carray(lanes.rows, (sizes.lanes, 2, 1, sizes.rows, at.row.width))[lane]
    buffers = Buffers(
        unowned(rows),
        unowned(carray(lanes.impacts, (sizes.lanes, 1, sizes.impacts))[lane]),
        unowned(carray(lanes.growths, (sizes.lanes, 1, sizes.growths))[lane]),
        unowned(carray(lanes.rows, (0, 1, 1))),
    )
    spare = unowned(carray(room.spare, (sizes.slots, INSTANTS)))
    group = Group(own, at, work, spare, carray(lanes.rows, (0,)), functions)  # seeks no extremes
    full, made = False, 0
    while made < budget and work[at.active, 0] > 0.0 and not full:
        made += 1
        wanted = generated.attempt(functions, work) | landing_lanes(own)
        full = wanted != 0 and attend_lanes(wanted, group, buffers.rows)
        if sizes.growths > 0 and work[at.accept, 0] > 0.0:
            generated.tangent_step(functions, work)
        generated.take(functions, work)
        if wanted != 0:
            full |= settle_lanes(wanted, group, buffers)
    for slot in range(sizes.slots):
        lanes.columns[slot * sizes.lanes + lane] = work[slot, 0]
    carray(lanes.runs, (sizes.lanes,))[lane] = own[0]
    lanes.made[lane] = made
