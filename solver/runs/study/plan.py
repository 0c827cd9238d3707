"""A study: a job of many points, filled in, with what each point is and how they are cut up."""

from dataclasses import dataclass, field
from typing import Any

from jointplay.records.arrays import Floats, Integers
from jointplay.records.channel import Channel
from jointplay.solver.integrators import method_for
from jointplay.solver.runs.starts import Perturbation
from jointplay.solver.runs.study.blocks import Chains
from jointplay.solver.runs.study.cycles import attributes_of
from jointplay.solver.runs.study.scenes import PointScenes
from jointplay.solver.scene.document import Scene


@dataclass(frozen=True, eq=False)
class Study:
    """A job of any kind but simulate that can run.

    Two studies are the same if their digests are.
    """

    kind: str
    job: dict[str, Any]
    """The job document with every default and every scene parameter present."""
    digest: str
    """SHA-256 of the filled-in job without its label."""
    parameters: tuple[str, ...]
    """Names of what varies from point to point; none in a poincare or an ensemble."""
    parameter_units: tuple[str, ...]
    observables: tuple[Channel, ...]
    """Columns of the sections; none in a sweep."""
    record: int
    """Sections recorded per point; 0 in a sweep. Without observables they are not kept."""
    channels: tuple[Channel, ...]
    """Channels whose peaks are kept per point; may be none."""
    indicators: tuple[str, ...]
    brief: bool
    """Only steps, onsets and what the job chose are kept of a point's statistics, and no grounds of
    its verdict."""
    perturbation: Perturbation | None
    """Perturbation of starts of points that differ in nothing else, or of several starts of each
    point; none: the start rule."""
    blocks: tuple[tuple[int, int], ...]
    """(first, count) of contiguous points. Without continuation whole bundles, the last one
    shorter; with it up to eight whole chains of one direction, of any length."""
    shape: tuple[int, ...]
    """Lengths of the axes over which results are kept: of one, all points; of two, y and x."""
    chain_of: Integers
    """(points,) index of each point's chain; a point without continuation is its own chain."""
    chain_order: Chains
    """Points of each chain in the order of computing."""
    structure: Integers
    """(points,) points with the same number have the same kernel; numbered by first appearance."""
    period: Floats
    """(points,) s: the drivers' least common period; in its absence the scene's own time scale."""
    offset: Floats
    """(points,) s: of a crank section within the period; 0 for other sections and a sweep."""
    settle: Floats
    """(points,) s: what is left out before; with "auto" the most that may be."""
    duration: Floats
    """(points,) s: the most that a point may take, settling included."""
    stored_bytes: int
    """Estimate of what the results take, before compression."""
    scenes: PointScenes
    compares_cycles: bool = field(default=False, kw_only=True)
    """Points keep mean and spread of their states over a cycle, by which attractors are told."""
    starts: int = field(default=1, kw_only=True)
    """From which each point is computed: as the scene says, and perturbed."""
    refine: int = field(default=0, kw_only=True)
    """Times that cells of the coarse grid of a map may be split; 0: every point is computed."""

    @property
    def points(self) -> int:
        """Number of points."""
        return len(self.scenes.values)

    @property
    def values(self) -> Floats:
        """(points, parameters), in the unit of each."""
        return self.scenes.values

    @property
    def tolerance(self) -> float:
        """Local error tolerance."""
        return float(self.job["tolerance"])

    @property
    def statistics(self) -> tuple[str, ...]:
        """Names of the statistics of channels and contacts that a sweep keeps per point."""
        return tuple(self.job.get("statistics", ()))

    @property
    def ends_with_events(self) -> bool:
        """Whether points end with their last section, whenever that is, or after `duration`."""
        return not {"onset", "channel"}.isdisjoint(self.job.get("section") or {})

    @property
    def keeps_ledger(self) -> bool:
        """Whether points have their works, and what the energy ledger lacks."""
        return not self.brief and bool(self.job.get("energies", True))

    @property
    def carries_exponents(self) -> bool:
        """Whether tangent vectors are carried with the points."""
        return "lyapunov" in self.indicators

    @property
    def method(self) -> str:
        """Name of the integration method, of `solver.integrators.METHODS`."""
        return method_for(self.job["method"], self.tolerance)

    def attributes(self) -> dict[str, Any]:
        """Return facts that a store keeps of this study beside its job and scene."""
        if not self.compares_cycles:
            return {}
        return {
            "states": attributes_of(self.point_scene(0), float(self.period[0])),
            "beyond_start": self.scenes.beyond_start,
        }

    def scene_document(self) -> dict[str, Any]:
        """Return the scene of the first point as stores keep it."""
        return self.point_scene(0).model_dump(mode="json")

    def point_scene(self, point: int) -> Scene:
        """Return the scene of a point with its parameters set, as checked on admission."""
        return self.scenes.scene(point)
