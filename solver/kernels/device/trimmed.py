"""Tapes of a job that asks for less."""

import dataclasses
from collections.abc import Collection, Iterable, Iterator

from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.emit.tapes import Source

ENERGIES = ("potential", "stored", "potential_start", "stored_start", "gross")
LEDGER = ("total", "ledger", "kledger")
"""Beginnings of names of blocks with the ledger's terms; the pairs' impulses, which contacts have,
are the last ones of each."""


def slots_of_energies(kernel: Kernel) -> set[int]:
    """Return the slots that energies and works alone need."""
    layout, terms = kernel.layout, len(kernel.equations.ledger)
    found = {layout[name] for name in ENERGIES}
    for name in (*LEDGER[:2], *(f"{LEDGER[2]}{k}_" for k in range(1, kernel.tableau.stages + 1))):
        if f"{name}0" in layout:
            first = layout[f"{name}0"]
            found |= set(range(first, first + terms - len(kernel.pairs)))
    return found


def without(slots: Collection[int], sources: Iterable[Source]) -> Iterator[Source]:
    """Yield tapes that do not store into some slots; what was computed for them falls away."""
    for one in sources:
        lines = (line for line in one.tape.splitlines() if _stored(line) not in slots)
        yield dataclasses.replace(one, tape="\n".join(lines))


def _stored(line: str) -> int:
    words = line.split()
    return int(words[1].rstrip("+")) if words[:1] == ["store"] else -1
