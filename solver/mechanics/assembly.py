"""Assembly: the pose and velocity at the start, degrees of freedom, redundant constraints."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import combinations
from types import MappingProxyType
from typing import Any, Final

import numpy as np

from jointplay.records.arrays import Flags, Floats
from jointplay.solver.mechanics.absolute import AbsoluteMechanism
from jointplay.solver.mechanics.closing import RANK_TOLERANCE, arrays, close, rank
from jointplay.solver.mechanics.drawing import drawn_angles, drawn_places
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.mechanics.view import view
from jointplay.solver.scene.channels import HOLDING
from jointplay.solver.scene.clocks import clocks
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.joints import Fixed, Prismatic, Revolute
from jointplay.solver.scene.latest import once_per_scene
from jointplay.solver.scene.pairs import has_play, pairs_of
from jointplay.solver.scene.references import ends

ASSEMBLED = 1e-11
"""Largest residual, in lengths of the shortest link, of an assembled mechanism."""
NEARBY, NEARBY_SEED, ASIDE = 3, 7, 0.05
"""Poses beside the start: how many, how they are drawn, and how far off, in rad and links."""
GEOMETRY: Final[Any] = {
    "ground": True,
    "bodies": {"__all__": {"points"}},
    "joints": True,
    "gears": True,
    "drivers": True,
    "start": True,
}
NOWHERE: Mapping[str, Floats] = MappingProxyType({})
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
    """Largest constraint residual, m or rad."""
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

    @property
    def redundant(self) -> int:
        """Dependent constraint rows of the ideal mechanism."""
        return self.constraints - self.rank


@once_per_scene
def shortest_link(scene: Scene) -> float:
    """Return the shortest distance between two joints on one body, m; the scene's length scale.

    Without any: the largest bearing radius or slider, else 1 m.
    """
    distances = link_lengths(scene)
    if distances:
        return min(distances)
    pairs = [pair for name, joint in scene.joints.items() for pair in pairs_of(name, joint)]
    return max((pair.size for pair in pairs), default=1.0)


def link_lengths(scene: Scene) -> list[float]:
    """Return the distances, m, between joints on one body that are apart; there may be none."""
    joined: dict[str, list[list[float]]] = {name: [] for name in scene.bodies}
    for joint in scene.joints.values():
        for _, reference in ends(joint):
            body, point = reference.split(".")
            if body in joined:
                joined[body].append(scene.bodies[body].points[point])
    distances = [math.dist(a, b) for points in joined.values() for a, b in combinations(points, 2)]
    return [d for d in distances if d > 0.0]


def directionless(scene: Scene, pose: Floats) -> list[str]:
    """Return the force elements that need a direction and whose points start in one place."""
    elements = {name: e for name, e in scene.forces.items() if e.needs_direction}
    if not elements:
        return []
    mechanism = AbsoluteMechanism(scene, view(scene), close_play=False)
    near, still = ASSEMBLED * shortest_link(scene), np.zeros_like(pose)
    return [
        name
        for name, element in elements.items()
        if math.hypot(*mechanism.ends((element.first, element.second), pose, still).gap) <= near
    ]


def first_clocks(scene: Scene) -> dict[str, float]:
    """Return each clock at t = 0."""
    return {name: clock.start for name, clock in clocks(scene).items()}


def first_angles(scene: Scene) -> dict[str, float]:
    """Return angles, rad, from which the assembly starts: as given, drawn, driven, or carried."""
    angles = {"ground": 0.0}
    chosen = drawn_angles(scene) | scene.start.angles
    for branch in spanning_tree(scene).branches:
        joint = scene.joints.get(branch.joint)
        offset = 0.0
        if isinstance(joint, Prismatic | Fixed):
            offset = joint.angle
        elif branch.driver is not None:
            driver = scene.drivers[branch.driver]
            offset = driver.at(driver.clock_start).value
        carried = angles[branch.parent] + (offset if branch.outward else -offset)
        given = chosen.get(branch.body)
        if branch.turned_by is not None:
            turning = scene.drivers[branch.turned_by]
            angles[branch.body] = turning.at(turning.clock_start).value
            continue
        prescribed = branch.driver is not None and isinstance(joint, Revolute)
        if prescribed or given is None:
            held = prescribed or isinstance(joint, Prismatic | Fixed)
            angles[branch.body] = carried if held else 0.0
        else:
            angles[branch.body] = given
    return angles


_found: dict[str, Assembly] = {}


@once_per_scene
def assemble(scene: Scene) -> Assembly:
    """Close the ideal mechanism by Newton's iteration; start values steer and fill freedom.

    Never raises for a mechanism that cannot close: the residual tells. Scenes of one geometry, as
    the points of most studies, share what was found for the first.
    """
    geometry = _geometry(scene)
    if geometry not in _found:
        while len(_found) >= MOST_KEPT:
            _found.pop(next(iter(_found)), None)
        _found[geometry] = _assembled(scene)
    return _found[geometry]


def _geometry(scene: Scene) -> str:
    """Return, as text, what an assembly depends on: no mass, no clearance, no law of contact."""
    found = scene.model_dump_json(include=GEOMETRY, exclude={"joints": {"__all__": {"clearance"}}})
    play = "".join(str(int(has_play(joint))) for joint in scene.joints.values())
    return f"{found} {play} {shortest_link(scene)!r}"


def _assembled(scene: Scene) -> Assembly:
    ideal = AbsoluteMechanism(scene, view(scene), close_play=True)
    length = shortest_link(scene)
    driven = first_clocks(scene)
    count = 3 * len(ideal.bodies)
    scale = np.tile([length, length, 1.0], len(ideal.bodies))
    still = np.zeros(count)

    angles = first_angles(scene)
    pose = first_pose(ideal, angles, driven, drawn_places(scene, angles))
    close(ideal, pose, driven, scale)
    residual, jacobian = arrays(ideal.rows(pose, still, driven), count)

    loose = AbsoluteMechanism(scene, view(scene), close_play=False)
    velocity = _start_velocity(ideal, pose, scale)
    loose_rows = loose.rows(pose, velocity, driven)
    _, open_jacobian = arrays(loose_rows, count)
    found, loose_rank = rank(jacobian * scale), rank(open_jacobian * scale)
    pose.flags.writeable = velocity.flags.writeable = False
    return Assembly(
        pose=pose,
        velocity=velocity,
        residual=float(np.abs(residual).max(initial=0.0)),
        constraints=len(residual),
        rank=found,
        freedom=count - found,
        freedom_with_play=count - loose_rank,
        redundant_with_play=len(open_jacobian) - loose_rank,
        rate=max((abs(float(row.rate)) for row in loose_rows), default=0.0),
    )


def first_pose(
    ideal: AbsoluteMechanism,
    angles: Mapping[str, float],
    driven: dict[str, float],
    places: Mapping[str, Floats] = NOWHERE,
) -> Floats:
    """Return a pose with these angles, rad by body, in which joints are as near as they come.

    places : centres of mass, (2,) m by body, of those that keep theirs.
    """
    count = 3 * len(ideal.bodies)
    pose = np.zeros(count)
    positions = np.arange(count) % 3 != 2
    for i, body in enumerate(ideal.bodies):
        pose[3 * i + 2] = angles[body]
        if body in places:
            pose[3 * i : 3 * i + 2] = places[body]
            positions[3 * i : 3 * i + 2] = False
    residual, jacobian = arrays(ideal.rows(pose, np.zeros(count), driven), count)
    if len(residual) and positions.any():  # revolute joints are linear in x and y
        step, *_ = np.linalg.lstsq(jacobian[:, positions], -residual, rcond=None)
        pose[positions] += step
    return pose


def poses_nearby(scene: Scene) -> Iterator[tuple[Floats, float, int]]:
    """Yield poses of the ideal mechanism beside its start, where it can move there.

    Each with its residual, in lengths of the shortest link, and the rank of the constraints; no
    pose where the mechanism came back to its start. Directions are drawn, the same each time.
    """
    start, length = assemble(scene).pose, shortest_link(scene)
    ideal = AbsoluteMechanism(scene, view(scene), close_play=True)
    driven, still = first_clocks(scene), np.zeros_like(start)
    scale = np.tile([length, length, 1.0], len(ideal.bodies))
    _, jacobian = arrays(ideal.rows(start, still, driven), len(start))
    _, values, directions = np.linalg.svd(jacobian * scale)
    free = directions[int((values > RANK_TOLERANCE * values[0]).sum()) :]
    for deviates in np.random.default_rng(NEARBY_SEED).standard_normal((NEARBY, len(free))):
        move = deviates @ free
        move *= ASIDE / np.abs(move).max()
        pose = start + scale * move
        close(ideal, pose, driven, scale)
        residual, jacobian = arrays(ideal.rows(pose, still, driven), len(pose))
        if np.abs((pose - start) / scale).max() > 0.1 * ASIDE:
            yield pose, float(np.abs(residual).max()) / length, rank(jacobian * scale)


def _start_velocity(ideal: AbsoluteMechanism, pose: Floats, scale: Floats) -> Floats:
    """Velocities of the ideal mechanism; those given, where play lets a body be thrown."""
    scene, driven = ideal.scene, first_clocks(ideal.scene)
    velocity = np.zeros(len(pose))
    for i, body in enumerate(ideal.bodies):
        velocity[3 * i : 3 * i + 2] = scene.start.velocities.get(body, (0.0, 0.0))
        velocity[3 * i + 2] = scene.start.angular_velocities.get(body, 0.0)
    everything = np.full(len(pose), True)
    for columns in (np.arange(len(pose)) % 3 != 2, everything, everything):
        # given angular velocities first carry the centres of mass along; the last pass removes
        # the rounding of the one before
        _admissible(ideal, pose, velocity, driven, scale, columns)
    if not scene.start.velocities:
        return velocity
    loosely = [joint for joint in scene.joints.values() if has_play(joint)]
    guided = {
        end.split(".")[0] for joint in loosely if joint.type in HOLDING for _, end in ends(joint)
    }
    for body, given in scene.start.velocities.items():
        i = 3 * ideal.bodies.index(body)
        velocity[i : i + 2] = given
        if body in guided:
            velocity[i + 2] = scene.start.angular_velocities.get(body, velocity[i + 2])
    thrown = [name for name, start in scene.start.joints.items() if start.rate is not None]
    loose = AbsoluteMechanism(scene, ideal.numbers, close_play=False, held=thrown)
    for _ in range(2):
        _admissible(loose, pose, velocity, driven, scale, everything)
    return velocity


def _admissible(
    mechanism: AbsoluteMechanism,
    pose: Floats,
    velocity: Floats,
    driven: dict[str, float],
    scale: Floats,
    columns: Flags,
) -> None:
    """Change some of the velocities, as little as possible, so that the constraints hold."""
    rows = mechanism.rows(pose, velocity, driven)
    if rows:
        _, jacobian = arrays(rows, len(pose))
        rates = np.array([row.rate for row in rows], np.float64)
        scaled = (jacobian * scale)[:, columns]
        step, *_ = np.linalg.lstsq(scaled, -rates, rcond=RANK_TOLERANCE)
        velocity[columns] += scale[columns] * step
