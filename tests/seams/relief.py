"""A kind of job over two axes, from outside: extremes and statistics as heights over a plane.

`python -m tests.seams.relief ...` is the command line of a program that has it.
"""

from typing import ClassVar, Literal

from jointplay import job_fields
from jointplay.solver.kinds import KINDS
from jointplay.solver.kinds.description import description
from jointplay.solver.kinds.extremes_study import ExtremesStudy, ExtremesStudyJob
from jointplay.solver.kinds.map import MapJob, points_of_map
from jointplay.solver.kinds.points import Points


class ReliefJob(ExtremesStudyJob, MapJob):
    """Peaks and statistics over two parameters."""

    kind: Literal["relief"]


class Relief(ExtremesStudy[ReliefJob]):
    """A point for each pair of values."""

    document: ClassVar = ReliefJob

    def points(self, job: ReliefJob) -> Points:
        """Return the map, coarse to fine."""
        return points_of_map(job)


if __name__ == "__main__":
    KINDS["relief"] = Relief()
    job_fields.KINDS.update(description())  # as the file would say that is made of the kinds
    from jointplay.command_line import main

    main()
