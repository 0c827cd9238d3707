"""Job documents: what a client asks for, strictly checked; one file a kind, this roster names them.

A member is a pydantic model; `solver.admission` has a module of the same name that fills it in.
"""

from typing import Annotated

from pydantic import Field

from solver.jobs.accuracy_study import AccuracyStudyJob
from solver.jobs.bifurcation import BifurcationJob
from solver.jobs.ensemble import EnsembleJob
from solver.jobs.job import ACCURACIES, Job, MechanismJob, PresetScene
from solver.jobs.poincare import PoincareJob
from solver.jobs.section import ChannelSection, CrankSection, OnsetSection, Section
from solver.jobs.simulate import SimulateJob
from solver.jobs.study import INDICATORS, SectionStudyJob
from solver.jobs.sweep import SweepJob

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
