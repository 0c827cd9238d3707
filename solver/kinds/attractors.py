"""The kinds that say on which attractor each of many starts ends."""

from collections.abc import Mapping
from typing import ClassVar

from jointplay.records.arrays import Floats
from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds.methods import check_reduced
from jointplay.solver.kinds.motion_map import J, Motions, MotionsJob
from jointplay.solver.kinds.phases import phase_offsets
from jointplay.solver.kinds.section import CrankSection
from jointplay.solver.kinds.section_study import indicators_of
from jointplay.solver.runs.study.cycles import outputs_of
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.runs.study.scenes import PointScenes
from jointplay.solver.statistics import Output


class AttractorKind(Motions[J]):
    """A kind whose points keep what tells their attractors apart; a member has these points."""

    compares_cycles: ClassVar = True

    def admit(self, job: J) -> Study:
        """Check and fill in; see `Kind.admit`."""
        check_distinguished(job, "Attractors are told apart by")
        return super().admit(job)

    def offset(self, job: J, scenes: PointScenes) -> Floats | None:
        """Return where sections lie that are the same whatever phase a driver begins with."""
        if not isinstance(job.section, CrankSection):
            return None
        return phase_offsets(scenes, job.section.crank_angle)

    def outputs(self, study: Study) -> Mapping[str, Output]:
        """Return the statistics that the job chose, and what tells attractors apart."""
        return {**super().outputs(study), **outputs_of(study.point_scene(0))}


def check_distinguished(job: MotionsJob, what: str) -> None:
    """Refuse (InvalidInput) what does not tell attractors apart; `what` needs joint coordinates."""
    check_reduced(job.formulation, what)
    if "recurrence" not in indicators_of(job):
        sentence = "Attractors are told apart by 'recurrence'; ask for that, too."
        raise InvalidInput.at("/indicators", sentence)
