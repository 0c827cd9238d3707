"""Job documents: what a client asks for, strictly checked; one file a kind, this roster names them.

A member is a pydantic model; `solver.admission` has a module of the same name that fills it in.
"""

from typing import Annotated

from pydantic import Field

from jointplay.solver.jobs.accuracy_study import AccuracyStudyJob
from jointplay.solver.jobs.bifurcation import BifurcationJob
from jointplay.solver.jobs.ensemble import EnsembleJob
from jointplay.solver.jobs.job import ACCURACIES, Job, MechanismJob, PresetScene
from jointplay.solver.jobs.poincare import PoincareJob
from jointplay.solver.jobs.section import ChannelSection, CrankSection, OnsetSection, Section
from jointplay.solver.jobs.simulate import SimulateJob
from jointplay.solver.jobs.study import INDICATORS, SectionStudyJob
from jointplay.solver.jobs.sweep import SweepJob

KINDS: dict[str, type[MechanismJob]] = {
    "simulate": SimulateJob,
    "bifurcation": BifurcationJob,
    "sweep": SweepJob,
    "poincare": PoincareJob,
    "ensemble": EnsembleJob,
    "accuracy-study": AccuracyStudyJob,
}
AnyJob = Annotated[
    SimulateJob | BifurcationJob | SweepJob | PoincareJob | EnsembleJob | AccuracyStudyJob,
    Field(discriminator="kind"),
]
"""A job of any kind, for schemas."""

__all__ = [
    "ACCURACIES",
    "INDICATORS",
    "KINDS",
    "AccuracyStudyJob",
    "AnyJob",
    "BifurcationJob",
    "ChannelSection",
    "CrankSection",
    "EnsembleJob",
    "Job",
    "MechanismJob",
    "OnsetSection",
    "PoincareJob",
    "PresetScene",
    "Section",
    "SectionStudyJob",
    "SimulateJob",
    "SweepJob",
]
