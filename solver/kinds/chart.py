"""The kind ``chart``: which motion there is over two parameters, point by point."""

from typing import ClassVar, Literal

from jointplay.solver.kinds.motion_map import MotionMap, MotionMapJob


class ChartJob(MotionMapJob):
    """A map over two parameters: what each point's motion is, and what is asked of it beside."""

    kind: Literal["chart"]


class Chart(MotionMap[ChartJob]):
    """A map of motions."""

    document = ChartJob
    results: ClassVar = ("points", "chart", "figures", "zarr")
