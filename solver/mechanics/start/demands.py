"""Demands on a start: the constraints of its joints, and what the scene gives of it."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.mechanics.absolute import AbsoluteMechanism
from jointplay.solver.mechanics.closing import arrays
from jointplay.solver.mechanics.rows import Row
from jointplay.solver.mechanics.start.given import Given, Rows, given_positions
from jointplay.solver.mechanics.view import view
from jointplay.solver.scene.clocks import clocks
from jointplay.solver.scene.document import Scene

CLOSED = 1e-11
"""Largest residual, in lengths of the shortest link, of an assembled mechanism."""
KEPT = 1e-10
"""The same of what holds of what is given."""


@dataclass(frozen=True)
class Demands:
    """Demands on a pose: constraints, and what is given."""

    scene: Scene
    closed: AbsoluteMechanism
    """All play closed."""
    loose: AbsoluteMechanism
    """Play let go, but where the scene says how a joint starts."""
    given: list[Given]
    driven: dict[str, float]
    """Each clock at t = 0."""
    length: float
    """Shortest link, m."""
    scale: Floats
    """(3 bodies,) that length, and a radian."""

    @classmethod
    def of(cls, scene: Scene, length: float) -> "Demands":
        """Return what a scene asks; length : of the shortest link, m."""
        numbers = view(scene)
        told = [*scene.start.joints, *scene.start.guides]
        closed = AbsoluteMechanism(scene, numbers, close_play=True)
        return cls(
            scene,
            closed,
            AbsoluteMechanism(scene, numbers, close_play=False, held=told),
            given_positions(closed, length),
            {name: clock.start for name, clock in clocks(scene).items()},
            length,
            np.tile([length, length, 1.0], len(closed.bodies)),
        )

    @property
    def free_angles(self) -> list[int]:
        """Columns of the angles of bodies of which neither an angle nor a point is given."""
        start = self.scene.start
        named = {*start.angles, *(name.split(".")[0] for name in start.points)}
        return [3 * i + 2 for i, body in enumerate(self.closed.bodies) if body not in named]

    def constraints(self, mechanism: AbsoluteMechanism, pose: Floats) -> Rows:
        """Return the rows of a mechanism's joints and drivers."""
        count = len(pose)
        return Rows(*arrays(mechanism.rows(pose.tolist(), [0.0] * count, self.driven), count))

    def slack(self, pose: Floats) -> list[Row]:
        """Return the rows of joints with play of which the scene does not say how they start."""
        rows = self.closed.rows(pose.tolist(), [0.0] * len(pose), self.driven)
        let_go = set(self.scene.joints).difference(self.loose.joints)
        return [row for row in rows if row.joint in let_go]

    def wanted(self, given: Iterable[Given], pose: Floats) -> Rows:
        """Return the rows of what is given, together."""
        still = np.zeros_like(pose)
        return Rows.joined([one.rows(pose, still) for one in given], len(pose))

    def is_closed(self, mechanism: AbsoluteMechanism, pose: Floats) -> bool:
        """Whether the constraints of a mechanism hold."""
        value = self.constraints(mechanism, pose).value
        return bool(np.abs(value).max(initial=0.0) <= CLOSED * self.length)

    def keeps(self, given: Iterable[Given], pose: Floats) -> bool:
        """Whether a pose keeps what is given."""
        return bool(np.abs(self.wanted(given, pose).value).max(initial=0.0) <= KEPT * self.length)
