"""The kind ``basins``: which attractor each start ends on, over two axes."""

from typing import ClassVar, Literal

from jointplay.solver.kinds.attractors import AttractorKind
from jointplay.solver.kinds.motion_map import MotionMap, MotionMapJob


class BasinsJob(MotionMapJob):
    """A map of basins of attraction: the attractor on which each point of two axes ends."""

    kind: Literal["basins"]


class Basins(AttractorKind[BasinsJob], MotionMap[BasinsJob]):
    """A map whose points keep what tells their attractors apart."""

    document = BasinsJob
    results: ClassVar = ("points", "chart", "attractors", "figures", "zarr")
