"""A calibration whose document was checked whole."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from jointplay.records.channel import Channel
from jointplay.solver.calibration.document import CalibrationTarget, Search, Spread
from jointplay.solver.calibration.space import Space
from jointplay.solver.calibration.targets import Goals
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.scene.document import Scene


@dataclass(frozen=True, eq=False)
class CheckedCase:
    """A case whose scene can be simulated at every corner of the parameters' box."""

    name: str
    parameters: dict[str, float | str | None]
    targets: tuple[CalibrationTarget, ...]
    channels: tuple[Channel, ...]
    """Channel of each target."""
    study: Study
    """A sweep over the corners: it makes the scene of any candidate."""

    @property
    def duration(self) -> float:
        """When the last window ends, s."""
        return max(target.stop for target in self.targets)


@dataclass(frozen=True, eq=False)
class Calibration:
    """A calibration that can be computed."""

    document: dict[str, Any]
    """Filled in: every default and every scene parameter present."""
    digest: str
    search: Search
    spread: Spread
    given: Mapping[str, float | str | None]
    """Parameters of a preset that the document sets."""
    scene_document: dict[str, Any]
    """The scene as it was written, its parameters at their defaults."""
    scene: Scene
    space: Space
    cases: tuple[CheckedCase, ...]
    goals: Goals
    """Goals of all targets, case after case."""

    @property
    def tolerance(self) -> float:
        """Local error tolerance of each run."""
        return float(self.document["tolerance"])

    @property
    def seed(self) -> int:
        """Seed of the search and of the spread."""
        return self.search.seed
