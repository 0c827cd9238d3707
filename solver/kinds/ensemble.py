"""The kind ``ensemble``: one set of parameters from many perturbed starts."""

from typing import Annotated, ClassVar, Literal

from jointplay.solver.kinds.idle_fields import check_idle
from jointplay.solver.kinds.limits import check_count
from jointplay.solver.kinds.methods import check_reduced
from jointplay.solver.kinds.perturbed import Seed, check_spread, spread_up_to
from jointplay.solver.kinds.points import Points, one_point
from jointplay.solver.kinds.section_study import SectionStudy, SectionStudyJob
from jointplay.solver.quantities.units import quantity
from jointplay.solver.runs.starts import Perturbation
from jointplay.solver.runs.study.plan import Study


class EnsembleJob(SectionStudyJob):
    """The sections of many runs that differ in their start alone; the first is unperturbed."""

    kind: Literal["ensemble"]
    members: Annotated[int, quantity("1", ge=1, le=10**12, description="number of starts")]
    spread: Annotated[float, spread_up_to(1.0)] = 1e-3
    seed: Seed = 0


class Ensemble(SectionStudy[EnsembleJob]):
    """A point for each member."""

    document = EnsembleJob
    results: ClassVar = ("points", "poincare", "figures", "zarr")

    def admit(self, job: EnsembleJob) -> Study:
        """Check and fill in; see `Kind.admit`."""
        if job.members == 1:
            check_idle(job, "several 'members'", "spread", "seed")
        else:
            check_spread(job.spread)
        return super().admit(job)

    def points(self, job: EnsembleJob) -> Points:
        """Return the members."""
        check_count(job.members, "/members")
        check_reduced(job.formulation, "The starts of an ensemble differ in")
        return one_point(job.members)

    def perturbation(self, job: EnsembleJob) -> Perturbation:
        """Return how members start apart."""
        return Perturbation(job.spread, job.seed)
