"""The kind ``poincare``: one trajectory over many periods, sections only."""

from typing import ClassVar, Literal

from jointplay.solver.kinds.points import Points, one_point
from jointplay.solver.kinds.section_study import SectionStudy, SectionStudyJob


class PoincareJob(SectionStudyJob):
    """The Poincare sections of one set of parameters."""

    kind: Literal["poincare"]


class Poincare(SectionStudy[PoincareJob]):
    """A single point."""

    document = PoincareJob
    results: ClassVar = ("points", "poincare", "figures", "zarr")

    def points(self, job: PoincareJob) -> Points:
        """Return the point."""
        return one_point()
