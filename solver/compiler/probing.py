"""Writes functions of two work arrays: one lane of the first, seen from all lanes of the second."""

from __future__ import annotations

from solver.compiler.emit import PROBING, lane_function
from solver.compiler.layout import LANES, Layout
from solver.compiler.recorder import Expression


def lend_function(first: int, last: int) -> str:
    """Return the source of lend(W, S, lane): give all lanes of S one lane's numbers."""
    slots = range(first, last)
    loads = [f"    v{s} = W[{s * LANES} + lane]" for s in slots]
    stores = [f"        S[{s * LANES} + l] = v{s}" for s in slots]
    lines = ["def lend(W, S, lane):", *loads, f"    for l in range({LANES}):", *stores]
    return "\n".join([PROBING, *lines]) + "\n"


Piece = tuple[str, str, list[tuple[str, Expression]]]
"""Lanes to write, where in the step (empty: as `theta` of S says), and what to evaluate."""


def probe_function(name: str, pieces: list[Piece], layout: Layout) -> str:
    """Return the source of (W, S, lane): read one lane of W, write lanes of S.

    What W holds is loaded before each loop: inside it, the compiler could not know that the two
    arrays do not overlap.
    """
    text = [PROBING, f"def {name}(W, S, lane):"]
    theta = f"W[{layout['theta'] * LANES} + l]"
    for lanes, instants, outputs in pieces:
        loads, lines = [], []
        for line in lane_function(name, outputs, layout).splitlines()[3:]:
            target, _, value = line.strip().partition(" = ")
            if value == theta:
                lines.append(f"        {target} = {instants or theta.replace('W[', 'S[')}")
            elif value.startswith("W["):
                loads.append(f"    {target} = {value.replace('+ l]', '+ lane]')}")
            else:
                lines.append("        " + f"{target} = {value}".replace("W[", "S["))
        text += [*loads, f"    for l in {lanes}:", *lines]
    return "\n".join(text) + "\n"
