"""The job of kind ``poincare``: one trajectory over many periods, sections only."""

from typing import Literal

from jointplay.solver.jobs.study import SectionStudyJob


class PoincareJob(SectionStudyJob):
    """The Poincare sections of one set of parameters."""

    kind: Literal["poincare"]
