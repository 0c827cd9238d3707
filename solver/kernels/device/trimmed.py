"""Tapes of a job that asks for less."""

import dataclasses
from collections.abc import Collection, Iterable, Iterator

from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.emit.tapes import Source

ENERGIES = ("potential", "stored", "potential_start", "stored_start", "gross")


def slots_of_energies(kernel: Kernel) -> set[int]:
    """Return the slots that energies and works alone need.

    Of the ledger's terms the last ones are the pairs' impulses, which contacts have.
    """
    layout, stages = kernel.layout, range(1, kernel.tableau.stages + 1)
    found = {layout[name] for name in ENERGIES}
    for name in ("total", "ledger", *(f"kledger{k}_" for k in stages)):
        terms = layout.block(name)
        found |= set(range(terms.start, terms.stop - len(kernel.pairs)))
    return found


def without(slots: Collection[int], sources: Iterable[Source]) -> Iterator[Source]:
    """Yield tapes that do not store into some slots; what was computed for them falls away."""
    for one in sources:
        lines = tuple(line for line in one.lines if _stored(line) not in slots)
        yield dataclasses.replace(one, lines=lines)


def _stored(line: str) -> int:
    words = line.split()
    return int(words[1].rstrip("+")) if words[:1] == ["store"] else -1
