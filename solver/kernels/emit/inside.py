"""Writes functions that look inside the step of one lane: eight instants of it at once.

They read one lane of W, where it is the same for all instants, and write S. `theta` of S says
where in the step the instants are.
"""

from collections.abc import Callable

from jointplay.solver.kernels.emit.emit import FixedNodes, Outputs, Tape
from jointplay.solver.kernels.emit.judged_step import before
from jointplay.solver.kernels.layout import Layout
from jointplay.solver.kernels.trace.equations import Equations


def source(
    equations: Equations,
    dense: Outputs,
    scanned: Outputs,
    rest: Outputs,
    layout: Layout,
    fixed: FixedNodes,
) -> str:
    """Return the source of what looks inside a step.

    `dense` : time, state, modes and impact rates at `theta` of the step. `scanned`, `rest` :
    channels, of the state, its time and its accelerations: those whose extremes are sought, and
    others, at which sections may be taken.
    """
    within, around = _within(layout), _around(layout)
    count = len(equations.coordinates)
    accelerations = [(f"slope{count + i}", a) for i, a in enumerate(equations.accelerations)]
    gaps = [
        (f"{name}{j}", expression)
        for j, pair in enumerate(equations.gaps)
        for name, expression in zip(("gap", "gap_rate"), pair, strict=True)
    ]
    slips = [(f"slip{j}", slip) for j, (slip, _) in enumerate(equations.slips)]

    states = Tape(layout, fixed, fetch=within)
    states.store(dense)
    approaches = Tape(layout, fixed, fetch=within)
    approaches.carry(dense)
    approaches.store([*gaps, *slips])
    channels = Tape(layout, fixed, fetch=within)
    channels.carry(dense)
    channels.carry(accelerations)
    channels.store([*scanned, *rest])
    channels.keep(name for name, _ in dense)
    surroundings = Tape(layout, fixed, fetch=around)
    surroundings.carry(dense)
    surroundings.carry(accelerations)
    surroundings.store(scanned)
    surroundings.keep(["stage_time"])
    return "\n\n".join(
        [
            states.function("states_within", "instants"),
            approaches.function("gaps_within", "instants"),
            channels.function("channels_within", "instants"),
            surroundings.function("channels_around", "instants"),
        ]
    )


def _within(layout: Layout) -> Callable[[str], str]:
    """Read this step, at the instants that S gives."""
    return lambda name: f"{'given' if name == 'theta' else 'spread'} {layout[name]}"


def _around(layout: Layout) -> Callable[[str], str]:
    """Read the step before at the first four instants, this one at the others; S gives them."""

    def fetch(name: str) -> str:
        if name == "theta":
            return f"given {layout[name]}"
        if before(name) in layout:
            return f"spread {layout[before(name)]} {layout[name]}"
        return f"spread {layout[name]}"

    return fetch
