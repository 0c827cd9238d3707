"""Writes functions that look inside the step of one lane: eight instants of it at once.

They read one lane of W, where it is the same for all instants, and write S. `theta` of S says
where in the step the instants are.
"""

from collections.abc import Callable

from jointplay.solver.kernels.emit.emit import FixedNodes, Outputs, Tape
from jointplay.solver.kernels.emit.stepping import before
from jointplay.solver.kernels.layout import INSTANTS, Layout
from jointplay.solver.kernels.record.equations import Equations

QUARTERS = [i / (INSTANTS // 2) for i in range(INSTANTS // 2)]


def source(
    equations: Equations, dense: Outputs, observed: Outputs, layout: Layout, fixed: FixedNodes
) -> str:
    """Return the source of what looks inside a step.

    `dense` : time, state, modes and impact rates at `theta` of the step; `observed` : channels, of
    the state, its time and its accelerations.
    """
    within, around = _within(layout), _around(layout)
    count = len(equations.coordinates)
    accelerations = [(f"slope{count + i}", a) for i, a in enumerate(equations.accelerations)]
    gaps = [
        (f"{name}{j}", expression)
        for j, pair in enumerate(equations.gaps)
        for name, expression in zip(("gap", "gap_rate"), pair, strict=True)
    ]

    states = Tape(layout, fixed, fetch=within)
    states.store(dense)
    approaches = Tape(layout, fixed, fetch=within)
    approaches.carry(dense)
    approaches.store(gaps)
    channels = Tape(layout, fixed, fetch=within)
    channels.carry(dense)
    channels.carry(accelerations)
    channels.store(observed)
    channels.keep(name for name, _ in dense)
    surroundings = Tape(layout, fixed, fetch=around)
    surroundings.carry(dense)
    surroundings.carry(accelerations)
    surroundings.store(observed)
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
    """Read quarters of the step before at the first four instants, of this one at the others."""

    def fetch(name: str) -> str:
        if name == "theta":
            return " ".join(["instants", *map(repr, QUARTERS * 2)])
        if before(name) in layout:
            return f"spread {layout[before(name)]} {layout[name]}"
        return f"spread {layout[name]}"

    return fetch
