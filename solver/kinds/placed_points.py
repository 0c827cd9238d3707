"""A study's points in their scene: which numbers each has, and which share their equations."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from jointplay.records.channel import Channel
from jointplay.solver.kinds.job import MechanismJob
from jointplay.solver.kinds.mechanism import offered, written
from jointplay.solver.kinds.points import Points
from jointplay.solver.runs.study.fields import distinct, structure_columns
from jointplay.solver.runs.study.scenes import PointScenes, leaves_of
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.parameters import set_parameters
from jointplay.solver.scene.references import has_play


@dataclass(frozen=True, eq=False)
class PlacedPoints:
    """Every point's scene, by the values that were put into it."""

    points: Points
    declared: Scene
    """As the job writes it, before parameters are set."""
    scenes: PointScenes
    structure: NDArray[np.int64]
    """(points,) points of the same number have equations of the same form."""

    def beginning(self, point: int) -> str:
        """Return how a sentence about one point begins; empty where nothing varies."""
        return self.points.name(point, self.declared) if self.points.axes else ""

    def channels(self, names: Iterable[str]) -> tuple[Channel, ...]:
        """Return the channels of these names."""
        known = {channel.name: channel for channel in offered(self.scenes.base)}
        return tuple(known[name] for name in names)

    def joints_with_play(self) -> set[str]:
        """Return the joints with clearance at any point."""
        firsts = np.unique(self.structure, return_index=True)[1]
        scenes = (self.scenes.scene(int(point)) for point in firsts)
        return {name for scene in scenes for name, joint in scene.joints.items() if has_play(joint)}


def place_points(job: MechanismJob, points: Points) -> PlacedPoints:
    """Return the points of a job that was admitted before."""
    document, declared, given = written(job)
    _, echo = set_parameters(document, declared, given)
    first, _ = set_parameters(document, declared, {**given, **points.at(0)})
    leaves = leaves_of(declared, points.parameters, echo)
    scenes = PointScenes(Scene.model_validate(first), leaves, points.values())
    return PlacedPoints(points, declared, scenes, structure_of(scenes))


def structure_of(scenes: PointScenes) -> NDArray[np.int64]:
    """Return (points,) the number of each point's structure, by first appearance."""
    return distinct(list(structure_columns(scenes)), len(scenes.values))
