"""Writes functions that look inside the step of one lane: eight instants of it at once.

They read one lane of W, where it is the same for all instants, and write S. `theta` of S says
where in the step the instants are.
"""

from collections.abc import Callable, Iterable

from jointplay.solver.kernels.emit.emit import FixedNodes, Outputs, Tape
from jointplay.solver.kernels.emit.judged_step import before
from jointplay.solver.kernels.emit.tapes import Source
from jointplay.solver.kernels.layout import Layout
from jointplay.solver.kernels.trace.equations import Equations, numbered


def source(
    equations: Equations,
    dense: Outputs,
    scanned: Outputs,
    rest: Outputs,
    layout: Layout,
    fixed: FixedNodes,
) -> list[Source]:
    """Return the sources of what looks inside a step.

    `dense` : time, state, modes and impact rates at `theta` of the step. `scanned`, `rest` :
    channels, of the state, its time and its accelerations: those whose extremes are sought, and
    others, at which sections may be taken.
    """
    count = len(equations.coordinates)
    accelerations = [(f"slope{count + i}", a) for i, a in enumerate(equations.accelerations)]
    penetrations = numbered(("penetration", "penetration_rate"), equations.penetrations)
    slips = [(f"slip{j}", slip) for j, (slip, _) in enumerate(equations.slips)]

    def within(name: str) -> str:
        """Read this step, at the instants that S gives."""
        return f"{'given' if name == 'theta' else 'spread'} {layout[name]}"

    def around(name: str) -> str:
        """Read the step before at the first four instants, this one at the others."""
        if before(name) in layout:
            return f"spread {layout[before(name)]} {layout[name]}"
        return within(name)

    def looking(
        name: str,
        fetch: Callable[[str], str],
        carried: Outputs,
        stored: Outputs,
        kept: Iterable[str] = (),
    ) -> Source:
        tape = Tape(layout, fixed, fetch=fetch)
        tape.carry(carried)
        tape.store(stored)
        tape.keep(kept)
        return tape.function(name, "instants")

    moving, everywhere = [*dense, *accelerations], [name for name, _ in dense]
    return [
        looking("states_within", within, [], dense),
        looking("penetrations_within", within, dense, [*penetrations, *slips]),
        looking("channels_within", within, moving, [*scanned, *rest], everywhere),
        looking("channels_around", around, moving, scanned, ["stage_time"]),
    ]
