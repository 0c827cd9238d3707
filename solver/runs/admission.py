"""An admitted trajectory: a simulation's job filled in, with what it will produce."""

from dataclasses import dataclass
from typing import Any

from jointplay.records.channel import Channel
from jointplay.solver.integrators import method_for
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.periods import section_offset

STANDARD_TOLERANCE = 1e-6
"""Local error per step of the named accuracy "standard"."""


@dataclass(frozen=True)
class Admission:
    """A simulation that can run."""

    job: dict[str, Any]
    """The job document with every default and every scene parameter present."""
    scene: Scene
    """The scene with its parameters set."""
    digest: str
    """SHA-256 of the filled-in job without its label."""
    channels: tuple[Channel, ...]
    """The selected channels, in the order of the scene."""
    samples: int
    """Length of the history: k * output_step from 0, and the duration last."""
    sections: int
    """Number of Poincare sections; 0 without a period."""
    period: float | None
    """Least common period of the drivers, s."""
    section_note: str
    """Why there is no section, else empty."""
    notes: tuple[str, ...]
    """Sentences on what the scene gives and the run does not keep."""
    joints: tuple[str, ...]
    """Contact pairs, in the order of the impacts' joint index."""
    stored_bytes: int
    """Estimate of what the results take, before compression."""

    @property
    def tolerance(self) -> float:
        """Local error tolerance; where the step is fixed, the standard one as a scale."""
        return float(self.job["tolerance"] or STANDARD_TOLERANCE)

    @property
    def steps_limit(self) -> int:
        """Most bytes of accepted steps to keep; 0 of a job that was filled in without it."""
        return int(self.job.get("steps_limit", 0))

    @property
    def settle(self) -> float:
        """Time from which peaks count, s; 0 of a job that was filled in without it."""
        return float(self.job.get("settle", 0.0))

    @property
    def method(self) -> str:
        """Name of the integration method, of `solver.integrators.METHODS`."""
        return method_for(self.job["method"], self.job["tolerance"])

    @property
    def offset(self) -> float:
        """Time of the first section, s; 0 without a period."""
        if self.period is None:
            return 0.0
        return section_offset(self.scene, self.period, self.job["section"]["crank_angle"])

    def scene_document(self) -> dict[str, Any]:
        """Return the scene as stores keep it."""
        return self.scene.model_dump(mode="json")
