"""Assembly: the pose and velocity at the start, degrees of freedom, redundant constraints."""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from itertools import combinations
from types import MappingProxyType
from typing import Any, Final, NamedTuple, TypeVar

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.bounded_dict import BoundedDict
from jointplay.solver.linear_algebra.orthogonal import Decomposition
from jointplay.solver.linear_algebra.products import applied
from jointplay.solver.mechanics.absolute import AbsoluteMechanism
from jointplay.solver.mechanics.closing import RANK_TOLERANCE, arrays, close, rank
from jointplay.solver.mechanics.start.centred import centred
from jointplay.solver.mechanics.start.closings import alike
from jointplay.solver.mechanics.start.demands import CLOSED, Demands
from jointplay.solver.mechanics.start.drawing import drawn_positions
from jointplay.solver.mechanics.start.given import Taken, distance, taken
from jointplay.solver.mechanics.start.guess import first_angles, first_clocks, first_pose
from jointplay.solver.mechanics.start.opening import opened, opened_but_for_one, within_play
from jointplay.solver.mechanics.start.pose import (
    FAR,
    hold,
    in_given_turns,
    nearest,
    unwound,
)
from jointplay.solver.mechanics.start.rates import start_rates
from jointplay.solver.mechanics.start.shared_closings import MECHANISM, shared_closings
from jointplay.solver.mechanics.view import view
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.once_per_scene import once_per_scene

ASSEMBLED = CLOSED
NEARBY, NEARBY_SEED, ASIDE = 3, 7, 0.05
"""Poses beside the start: how many, how they are drawn, and how far off, in rad and links."""
LAWS: Final = {"contact", "friction"}
"""Parts of a clearance that no pose depends on."""
GEOMETRY: Final[Any] = MECHANISM | {"start": True}
RATES: Final[Any] = {
    "angular_velocities": True,
    "velocities": True,
    "joints": {"__all__": {"rate"}},
    "guides": {"__all__": {"rate", "tilt_rate"}},
}
"""Parts of a start on which a pose does not depend."""
REPORTED = 1e-6
"""Share of the shortest link, or of 1 m, up to which a difference is not reported, m or m/s."""
NOTHING: Mapping[str, Any] = MappingProxyType({})
Kept = TypeVar("Kept")
MOST_KEPT = 512
"""Assemblies that are kept; studies of one geometry need one."""


@dataclass(frozen=True)
class Assembly:
    """A mechanism put together at t = 0, journals where they start, concentric by default."""

    pose: Floats
    """(3 bodies,) x, y (m) and theta (rad) of each body."""
    velocity: Floats
    """(3 bodies,) their rates."""
    residual: float
    """Largest constraint residual, m or rad, of joints that are not let go."""
    constraints: int
    """Number of constraint rows, journals held."""
    rank: int
    """Number of independent ones."""
    freedom: int
    """Degrees of freedom of the ideal mechanism."""
    freedom_with_play: int
    """Degrees of freedom once joints with clearance are let go."""
    redundant_with_play: int
    """Dependent rows that remain then."""
    rate: float
    """Largest rate at which constraints are violated then, m/s or rad/s; above zero if drivers
    fight."""
    given: tuple[Taken, ...]
    """All values that the scene gives of the start, and those that are taken."""

    reported: float
    """Smallest difference from what is given that is reported, m or m/s."""

    @property
    def misfits(self) -> list[Taken]:
        """Return what is given and not kept."""
        return [one for one in self.given if one.off > self.reported]

    @property
    def redundant(self) -> int:
        """Dependent constraint rows of the ideal mechanism."""
        return self.constraints - self.rank


@once_per_scene
def shortest_link(scene: Scene) -> float:
    """Return the shortest distance between two joints on one body, m; the scene's length scale.

    Without any: the largest bearing radius, cam or slider, else 1 m. A cam that is hardly larger
    than its lash is a point, which has no size.
    """
    distances = link_lengths(scene)
    if distances:
        return min(distances)
    loose = [joint for joint in scene.joints.values() if joint.slack is not None]
    sizes = [joint.size for joint in loose if not joint.is_point]
    return max(sizes, default=1.0)


def link_lengths(scene: Scene) -> list[float]:
    """Return the distances, m, between joints on one body that are apart; there may be none."""
    joined: dict[str, list[list[float]]] = {name: [] for name in scene.bodies}
    for joint in scene.joints.values():
        for reference in joint.points:
            body, point = reference.split(".")
            if body in joined:
                joined[body].append(scene.bodies[body].points[point])
    distances = [math.dist(a, b) for points in joined.values() for a, b in combinations(points, 2)]
    return [d for d in distances if d > 0.0]


def directionless(scene: Scene, pose: Floats) -> list[str]:
    """Return the force elements that need a direction and whose points coincide at the start."""
    elements = {name: e for name, e in scene.forces.items() if e.needs_direction}
    return _coincident(scene, pose, {n: (e.first, e.second) for n, e in elements.items()})


def undecided(scene: Scene) -> list[str]:
    """Return the joints that hold points apart which coincide at the start, and may go to any side.

    Those of bodies that `start.points` demands are not among them.
    """
    placed = {point.split(".")[0] for point in scene.start.points}
    pairs = {
        name: joint.points
        for name, joint in scene.joints.items()
        if joint.needs_direction and placed.isdisjoint(joint.bodies)
    }
    if not pairs:
        return []
    return _coincident(scene, _guess(Demands.of(scene, shortest_link(scene))), pairs)


def _coincident(scene: Scene, pose: Floats, pairs: Mapping[str, tuple[str, str]]) -> list[str]:
    if not pairs:
        return []
    mechanism = AbsoluteMechanism(scene, view(scene), close_play=False)
    near, still = ASSEMBLED * shortest_link(scene), np.zeros_like(pose)
    return [
        name
        for name, pair in pairs.items()
        if math.hypot(*mechanism.ends(pair, pose, still).gap) <= near
    ]


@dataclass(frozen=True)
class _Found:
    """Assemblies of one geometry, whatever its clearances are."""

    demands: Demands
    closed: Assembly
    """With joints with play closed."""
    opened: Assembly | None
    """With joints with play as far open as what is given needs, where it needs that."""

    @property
    def stretched(self) -> bool:
        """Whether joints with play would be opened as far as they go for what is given."""
        return bool(self.closed.misfits and self.demands.slack(self.closed.pose))


class _Poses(NamedTuple):
    """Poses of a scene, whatever its rates are, as `_Found` has their assemblies."""

    closed: Floats
    opened: Floats | None


_found: BoundedDict[str, _Found] = BoundedDict(MOST_KEPT)
_poses: BoundedDict[str, _Poses] = BoundedDict(MOST_KEPT)


@once_per_scene
def assemble(scene: Scene) -> Assembly:
    """Put the ideal mechanism together, nearest to what is given: see `start.pose`, `start.rates`.

    Never raises for a mechanism that cannot close: the residual tells. Scenes of one geometry, as
    the points of most studies, share what was found for the first.
    """
    found = _found_of(scene)
    if found.opened is not None and within_play(found.demands, scene, found.opened.pose):
        return found.opened
    if not found.stretched:
        return found.closed
    pose = opened_but_for_one(found.demands, scene, found.closed.pose)
    return found.closed if pose is None else _assembly(found.demands, found.demands.loose, pose)


def opens_play(scene: Scene) -> bool:
    """Return whether what is given opens play: then the start depends on how large it is."""
    found = _found_of(scene)
    return found.opened is not None or found.stretched


def assemble_closed(scene: Scene) -> Assembly:
    """Put the ideal mechanism together with all play closed, also where what is given opens it."""
    return _found_of(scene).closed


def _found_of(scene: Scene) -> _Found:
    return _once(_found, _geometry(scene), lambda: _assembled(scene))


def _once(kept: BoundedDict[str, Kept], key: str, find: Callable[[], Kept]) -> Kept:
    """Return what is kept under a key, or is found now."""
    found = kept.get(key)
    if found is None:
        found = kept[key] = find()
    return found


def start_of(scene: Scene, one: Scene) -> tuple[Floats, Floats]:
    """Return the pose, (3 bodies,), and the rates, (3 bodies, points), at the start of many points.

    They differ in speeds of drivers, and in clearances that nothing given opens; `one` is the scene
    of one of them. ValueError or TypeError where more differs that poses depend on, or rates are
    given, which hold or not by point.
    """
    play: Any = {"joints": {"__all__": {"clearance": LAWS if opens_play(one) else True}}}
    scene.model_dump_json(include=GEOMETRY, exclude=play | {"drivers": {"__all__": {"speed"}}})
    pose = assemble(one).pose
    rates, given = start_rates(Demands.of(scene, shortest_link(scene)), pose)
    if given:
        raise ValueError("rates are given")
    return pose, rates


def _geometry(scene: Scene, without: Mapping[str, Any] = NOTHING) -> str:
    """Return, as text, what an assembly depends on: no mass, no clearance, no law of contact.

    without : parts of the start that are left out.
    """
    exclude: Any = {"joints": {"__all__": {"clearance"}}, "start": without}
    found = scene.model_dump_json(include=GEOMETRY, exclude=exclude)
    play = "".join(str(int(joint.has_play)) for joint in scene.joints.values())
    turns = [element.turns_counted() for element in scene.forces.values()]
    return f"{found} {play} {shortest_link(scene)!r} {turns}"


def _assembled(scene: Scene) -> _Found:
    demands = Demands.of(scene, shortest_link(scene))
    poses = _once(_poses, _geometry(scene, RATES), lambda: _posed(demands))
    return _Found(
        demands,
        _assembly(demands, demands.closed, poses.closed.copy()),
        None if poses.opened is None else _assembly(demands, demands.loose, poses.opened.copy()),
    )


def _posed(demands: Demands) -> _Poses:
    guess = _guess(demands)
    pose = guess.copy()
    close(demands.closed, pose, demands.driven, demands.scale)
    pose = in_given_turns(demands, pose)
    if demands.is_closed(demands.closed, pose) and demands.keeps(demands.given, pose):
        return _Poses(pose, None)
    opening = opened(demands, guess, demands.given)
    return _Poses(_nearer(demands, pose), opening)


def _guess(demands: Demands) -> Floats:
    angles = first_angles(demands.scene)
    return first_pose(
        demands.closed, angles, demands.driven, drawn_positions(demands.scene, angles)
    )


def _nearer(demands: Demands, pose: Floats) -> Floats:
    """Return the closed pose that is to be taken where the one first found does not keep all."""
    still, poses = np.zeros_like(pose), [pose] if demands.is_closed(demands.closed, pose) else []
    if not poses or distance(demands.given, pose, still) > FAR * demands.length:
        poses += [in_given_turns(demands, closing) for closing in shared_closings(demands)]
    if not poses:
        return pose
    found = nearest(demands, poses)
    _, jacobian = demands.constraints(demands.closed, found)
    if rank(jacobian * demands.scale) < len(pose):
        return hold(demands, found)
    return pose if alike(pose, found, demands.scale) else found


def _assembly(demands: Demands, held: AbsoluteMechanism, pose: Floats) -> Assembly:
    """Return what a pose comes to, in which the joints of a mechanism are held."""
    pose = centred(demands, held, unwound(demands, held, pose))
    count, still = len(pose), np.zeros_like(pose)
    residual = demands.constraints(held, pose).value
    constraints, jacobian = demands.constraints(demands.closed, pose)
    velocity, rates = start_rates(demands, pose)
    loose = AbsoluteMechanism(demands.scene, demands.closed.numbers, close_play=False)
    loose_rows = loose.rows(pose.tolist(), velocity.tolist(), demands.driven)
    _, open_jacobian = arrays(loose_rows, count)
    found, loose_rank = rank(jacobian * demands.scale), rank(open_jacobian * demands.scale)
    pose.flags.writeable = velocity.flags.writeable = False
    return Assembly(
        pose=pose,
        velocity=velocity,
        residual=float(np.abs(residual).max(initial=0.0)),
        constraints=len(constraints),
        rank=found,
        freedom=count - found,
        freedom_with_play=count - loose_rank,
        redundant_with_play=len(open_jacobian) - loose_rank,
        rate=max((abs(float(row.rate)) for row in loose_rows), default=0.0),
        given=(*taken(demands.given, pose, still), *taken(rates, pose, velocity)),
        reported=REPORTED * min(1.0, demands.length),
    )


def poses_nearby(scene: Scene, *, close_play: bool = True) -> Iterator[tuple[Floats, float, int]]:
    """Yield poses of the mechanism, ideal or with play, beside its start, where it can move there.

    Each with its residual, in lengths of the shortest link, and the rank of the constraints; no
    pose where the mechanism came back to its start. Directions are drawn, the same each time.
    """
    start, length = assemble(scene).pose, shortest_link(scene)
    ideal = AbsoluteMechanism(scene, view(scene), close_play=close_play)
    driven, still = first_clocks(scene), np.zeros_like(start)
    scale = np.tile([length, length, 1.0], len(ideal.bodies))
    _, jacobian = arrays(ideal.rows(start, still, driven), len(start))
    free = Decomposition(jacobian * scale, RANK_TOLERANCE).free
    generator = np.random.default_rng(NEARBY_SEED)
    for deviates in generator.standard_normal((NEARBY, free.shape[1])):
        move = applied(free, deviates)
        move *= ASIDE / np.abs(move).max()
        pose = start + scale * move
        close(ideal, pose, driven, scale)
        residual, jacobian = arrays(ideal.rows(pose, still, driven), len(pose))
        if np.abs((pose - start) / scale).max() > 0.1 * ASIDE:
            yield pose, float(np.abs(residual).max()) / length, rank(jacobian * scale)
