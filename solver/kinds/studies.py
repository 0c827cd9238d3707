"""Studies: points in their scene, cut into chains and blocks, with what is said of each."""

from abc import abstractmethod
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from jointplay.records.arrays import Floats, Integers
from jointplay.records.channel import Channel
from jointplay.solver.kinds import documents
from jointplay.solver.kinds.job import MechanismJob
from jointplay.solver.kinds.kind import J, Kind
from jointplay.solver.kinds.limits import BYTES_PER_BRIEF_POINT, BYTES_PER_POINT, BYTES_PER_VALUE
from jointplay.solver.kinds.mechanism import Echo, written
from jointplay.solver.kinds.periods import Periods, periods
from jointplay.solver.kinds.points import Points
from jointplay.solver.runs.starts import Perturbation
from jointplay.solver.runs.study.blocks import (
    Alone,
    Blocks,
    Chains,
    chained_blocks,
    chains_of,
    independent_blocks,
    refined_blocks,
)
from jointplay.solver.runs.study.fields import distinct, structure_columns
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.runs.study.scenes import PointScenes, leaves_of
from jointplay.solver.scene.channels import channels
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.pairs import contact_pairs
from jointplay.solver.scene.parameters import set_parameters


@dataclass(frozen=True, eq=False)
class PlacedPoints:
    """Every point's scene, by the values that were put into it."""

    points: Points
    declared: Scene
    """As the job writes it, before parameters are set."""
    scenes: PointScenes
    document: dict[str, Any]
    """The scene document with the parameters that do not vary."""
    echo: Echo

    @cached_property
    def structure(self) -> Integers:
        """(points,) points of the same number have equations of the same form."""
        return distinct(list(structure_columns(self.scenes)), self.points.count)

    @cached_property
    def first_scenes(self) -> dict[int, Scene]:
        """The first point of each structure, in the order of their numbers, and its scene."""
        points = np.unique(self.structure, return_index=True)[1].tolist()
        return {point: self.scenes.scene(point) for point in points}

    def beginning(self, point: int) -> str:
        """Return how a sentence about one point begins; empty where nothing varies."""
        return self.points.name(point, self.declared) if self.points.axes else ""

    def channels(self, names: Iterable[str]) -> tuple[Channel, ...]:
        """Return the channels of these names."""
        known = {channel.name: channel for channel in channels(self.scenes.base)}
        return tuple(known[name] for name in names)

    def pairs(self) -> set[str]:
        """Return the contact pairs that any point has."""
        return {name for scene in self.first_scenes.values() for name in contact_pairs(scene)}


def place_points(job: MechanismJob, points: Points) -> PlacedPoints:
    """Return the points of a job that was admitted before."""
    document, declared, given = written(job)
    kept, echo = set_parameters(document, declared, given, points.parameters)
    first, _ = set_parameters(document, declared, {**given, **points.at(0)})
    leaves = leaves_of(declared, points.parameters, echo)
    scenes = PointScenes(Scene.model_validate(first), leaves, points.values())
    return PlacedPoints(points, declared, scenes, kept, of_parameters(echo, points))


def of_parameters(echo: Echo, points: Points) -> Echo:
    """Return the values of declared parameters, without numbers of the start that vary."""
    starts = {axis.parameter for axis in points.axes if axis.start}
    return {name: value for name, value in echo.items() if name not in starts}


class StudyKind(Kind[J]):
    """A kind whose answer is points, all of which are known before the first is computed."""

    @abstractmethod
    def points(self, job: J) -> Points:
        """Return the points of a job; see `Kind.admit` for how they are refused."""

    @abstractmethod
    def study(self, job: J, filled: dict[str, Any], placed: PlacedPoints, units: Periods) -> Study:
        """Return the study of a job, at points that have these units of time."""

    def plan(self, job: J, filled: dict[str, Any]) -> Study:
        """Return what `admit` returned; see `Kind.plan`."""
        placed = place_points(job, self.points(job))
        return self.study(job, filled, placed, periods(placed.scenes))


@dataclass(frozen=True, eq=False)
class Spans:
    """Times of the run of each value, s; see the same names of `Study`."""

    period: Floats
    settle: Floats
    duration: Floats
    offset: Floats | None = None
    """None: no section is taken at a crank angle."""


@dataclass(frozen=True)
class Kept:
    """Results that are kept of each point; see the same names of `Study`."""

    observables: tuple[Channel, ...] = ()
    record: int = 0
    channels: tuple[Channel, ...] = ()
    statistics: int = 0
    """Numbers beside sections and extremes."""
    indicators: tuple[str, ...] = ()
    brief: bool = False
    compares_cycles: bool = False
    starts: int = 1
    refine: int = 0


def make_study(
    filled: dict[str, Any],
    placed: PlacedPoints,
    spans: Spans,
    kept: Kept = Kept(),
    continuation: tuple[str, int] = ("none", 1),
    perturbation: Perturbation | None = None,
) -> Study:
    """Return the study of a filled-in job.

    `continuation` : the direction, and the number of chains in each.
    """
    direction, segments = continuation
    points = placed.points
    chains = chains_of(points.count, direction, segments)
    total = len(chains)
    chain_of = np.arange(total)
    if direction != "none":
        total = sum(len(chain) for chain in chains)
        chain_of = np.empty(total, np.int64)
        for index, chain in enumerate(chains):
            chain_of[list(chain)] = index
    row = np.arange(total) % points.count  # the values once more for the other direction
    offset = np.zeros(points.count) if spans.offset is None else spans.offset
    declared = placed.declared.parameters
    sections = kept.record * (len(kept.observables) + 1) if kept.observables else 0
    own = BYTES_PER_BRIEF_POINT if kept.brief else BYTES_PER_POINT
    numbers = sections + 4 * len(kept.channels) + kept.statistics
    return Study(
        kind=filled["kind"],
        job=filled,
        digest=documents.digest(filled),
        parameters=points.parameters,
        parameter_units=tuple(declared[name].unit for name in points.parameters),
        observables=kept.observables,
        record=kept.record,
        channels=kept.channels,
        indicators=kept.indicators,
        brief=kept.brief,
        compares_cycles=kept.compares_cycles,
        starts=kept.starts,
        refine=kept.refine,
        perturbation=perturbation,
        blocks=_blocks(chains, points, kept.refine),
        shape=points.shape if total == points.count else (total,),
        chain_of=chain_of,
        chain_order=chains,
        structure=placed.structure[row],
        period=spans.period[row],
        offset=offset[row],
        settle=spans.settle[row],
        duration=spans.duration[row],
        stored_bytes=int(total * (BYTES_PER_VALUE * numbers + own)),
        scenes=placed.scenes.at_rows(row),
    )


def _blocks(chains: Chains, points: Points, refine: int) -> Blocks:
    """Return how points are cut up that are computed in chains, or on a map that is refined."""
    if refine:
        return refined_blocks(points.shape, refine)
    if isinstance(chains, Alone):
        return independent_blocks(points.count)
    return chained_blocks(chains, points.count)
