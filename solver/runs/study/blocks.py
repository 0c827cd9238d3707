"""Chains of continuation and blocks of work that the points of a study are cut into.

Nothing here depends on the workers: the same study always has the same chains and blocks.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate, pairwise
from typing import overload

import numpy as np

from jointplay.records.coarse_to_fine import coarse_points, refined, tiles
from jointplay.solver.kernels.layout import BUNDLE

MOST_POINTS = 64
"""Points of a block without continuation, eight bundles, as long as that makes few blocks."""
MOST_BLOCKS = 2048
"""Blocks without continuation: of more points each has more than 64."""
BLOCKS = 8
"""That a study is cut into while its blocks are smaller than that."""

Chains = Sequence[Sequence[int]]
Blocks = tuple[tuple[int, int], ...]


def independent_blocks(points: int) -> Blocks:
    """Return (first, count) of blocks of whole bundles, alike within one; the last may be shorter.

    The longer ones come first, so that workers finish at about the same time.
    """
    bundles = -(-points // BUNDLE)
    count = min(bundles, max(BLOCKS, -(-bundles * BUNDLE // MOST_POINTS)), MOST_BLOCKS)
    ends = [BUNDLE * part.stop for part in segments(bundles, count)]
    return tuple((first, min(end, points) - first) for first, end in pairwise([0, *ends]))


def refined_blocks(shape: tuple[int, ...], depth: int) -> Blocks:
    """Return blocks of a map that is refined: of its coarse grid, then of whole tiles."""
    order, coarse = refined(shape, depth), coarse_points(shape, depth)
    found = independent_blocks(coarse)
    begins = np.flatnonzero(np.diff(tiles(order[coarse:], shape), prepend=-1)).tolist()
    parts = segments(len(begins), MOST_BLOCKS) if begins else []
    ends = [coarse + begins[part.start] for part in parts] + [len(order)]
    return found + tuple((first, end - first) for first, end in pairwise(ends))


def segments(values: int, count: int) -> list[range]:
    """Return `count` contiguous segments of the values, none empty, lengths within one."""
    count = min(count, values)
    short, longer = divmod(values, count)
    ends = accumulate([0] + [short + 1] * longer + [short] * (count - longer))
    return [range(first, last) for first, last in pairwise(ends)]


@dataclass(frozen=True)
class Alone(Sequence[Sequence[int]]):
    """Chains of points of which each is its own; a million of them take no memory."""

    points: int

    def __len__(self) -> int:
        return self.points

    @overload
    def __getitem__(self, index: int) -> Sequence[int]: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Sequence[int]]: ...
    def __getitem__(self, index: int | slice) -> Sequence[int] | Sequence[Sequence[int]]:
        """Return a chain, or several."""
        points = range(self.points)[index]
        return [(point,) for point in points] if isinstance(points, range) else (points,)


def chains_of(values: int, continuation: str, count: int) -> Chains:
    """Return the points of each chain in the order of computing.

    Points are numbered in the order of the values; where both directions are computed, the
    backward ones follow all forward ones, again in the order of the values.
    """
    if continuation == "none":
        return Alone(values)
    found: list[tuple[int, ...]] = []
    if continuation in ("forward", "both"):
        found += [tuple(segment) for segment in segments(values, count)]
    if continuation in ("backward", "both"):
        shift = values if continuation == "both" else 0
        found += [
            tuple(shift + point for point in reversed(segment))
            for segment in segments(values, count)
        ]
    return tuple(found)


def chained_blocks(chains: Chains, values: int) -> Blocks:
    """Return (first, count) of blocks of up to eight whole chains of one direction.

    Each lane runs a chain, so a block is as long as eight of them, however many points that is.
    """
    blocks: list[tuple[int, int]] = []
    directions = sum(len(chain) for chain in chains) // values
    per_direction = len(chains) // directions
    for direction in range(directions):
        own = chains[direction * per_direction : (direction + 1) * per_direction]
        for begin in range(0, per_direction, BUNDLE):
            group = own[begin : begin + BUNDLE]
            blocks.append((min(map(min, group)), sum(map(len, group))))
    return tuple(blocks)
