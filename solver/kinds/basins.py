"""The kind ``basins``: which attractor each start ends on, over two axes."""

from typing import ClassVar, Literal

from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds.attractors import AttractorKind
from jointplay.solver.kinds.motion_map import MotionMap, MotionMapJob
from jointplay.solver.runs.study.plan import Study


class BasinsJob(MotionMapJob):
    """A map of basins of attraction: the attractor on which each point of two axes ends."""

    kind: Literal["basins"]


class Basins(AttractorKind[BasinsJob], MotionMap[BasinsJob]):
    """A map whose points keep what tells their attractors apart."""

    document = BasinsJob
    results: ClassVar = ("points", "chart", "attractors", "figures", "zarr")

    def admit(self, job: BasinsJob) -> Study:
        """Check and fill in; see `Kind.admit`."""
        study = super().admit(job)
        if not study.scenes.starts_vary:
            sentence = (
                "Basins are of starts: give a number of the start along one axis, such as"
                " {'start': '/start/angles/rod', 'values': …}, or ask for a chart."
            )
            raise InvalidInput.at("/by", sentence)
        return study
