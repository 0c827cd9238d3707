"""A search for the worst: random points of the unit cube, and points beside the worst so far."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from benchmarks.lies.draw import anywhere, beside

FRESH = 0.5
"""Share of the runs that begin anywhere."""


class Found(NamedTuple):
    """Outcome at a point of the unit cube."""

    niche: str
    """The worst of each niche is where the search goes on."""
    drawn: int
    """Coordinates that matter."""
    badness: float | None
    """None where it is not judged: no place to go on from."""


def climb(seed: int, runs: int, look: Callable[[list[float]], Found]) -> None:
    """Look at `runs` points, the same for the same seed."""
    random = np.random.default_rng(seed)
    worst: dict[str, tuple[Found, list[float]]] = {}
    for _ in range(runs):
        if not worst or random.random() < FRESH:
            point = anywhere(random)
        else:
            found, start = list(worst.values())[int(random.integers(len(worst)))]
            point = beside(start, found.drawn, random)
        found = look(point)
        if found.badness is None:
            continue
        before = worst.get(found.niche)
        if before is None or (before[0].badness or 0.0) < found.badness:
            worst[found.niche] = (found, point)
