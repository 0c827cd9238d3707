"""Cuts a long tape into pieces, which are compiled one by one.

What a compiler takes for one block grows faster than the block. Pieces are tapes with two more
statements::

    keep 3 v12              at place 3 of a record that all pieces share
    v12 = kept 3

They compute what the whole does, but where a product and its sum are in different pieces they are
rounded one by one.
"""

from collections.abc import Sequence
from itertools import accumulate, pairwise

LONGEST = 7000
"""Statements that are compiled as one block, more than any preset's."""


def cut(tape: Sequence[str], longest: int = LONGEST) -> tuple[list[list[str]], int]:
    """Return the pieces of a tape, in their order, and the number of places of their record."""
    last = {name: i for i, line in enumerate(tape) for name in (*_defined(line), *_used(line))}
    bounds = _bounds(tape, longest, last)
    pieces: list[list[str]] = []
    places: dict[str, int] = {}
    free: list[int] = []
    count = 0
    for first, end in pairwise(bounds):
        piece: list[str] = []
        here: set[str] = set()
        for line in tape[first:end]:
            for name in _used(line):
                if name not in here:
                    here.add(name)
                    piece.append(f"{name} = kept {places[name]}")
            piece.append(line)
            for name in _defined(line):
                here.add(name)
                if last[name] >= end:
                    if not free:
                        free, count = [count], count + 1
                    places[name] = free.pop()
                    piece.append(f"keep {places[name]} {name}")
        # what later pieces do not read gives its place to others
        free += [places.pop(name) for name in list(places) if last[name] < end]
        pieces.append(piece)
    return pieces, count


def _bounds(tape: Sequence[str], longest: int, last: dict[str, int]) -> list[int]:
    """Return where pieces begin and end: where, in their second half, fewest values cross."""
    changes = [0] * (len(tape) + 2)
    for i, line in enumerate(tape):
        for name in _defined(line):
            changes[i + 1] += 1
            changes[last[name] + 1] -= 1
    crossing = list(accumulate(changes))
    bounds = [0]
    while len(tape) - bounds[-1] > longest:
        places = range(bounds[-1] + longest // 2, bounds[-1] + longest + 1)
        bounds.append(min(places, key=crossing.__getitem__))
    return [*bounds, len(tape)]


def _defined(line: str) -> list[str]:
    name, equals, *_ = line.split()
    return [name] if equals == "=" else []


def _used(line: str) -> list[str]:
    return [word for word in line.split()[1:] if word.startswith("v")]
