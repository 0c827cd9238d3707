"""The mechanics on plain floats: a scene at one instant, in either formulation."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from jointplay.solver.kinds import Admission, admit
from jointplay.solver.mechanics.assembly import assemble, shortest_link
from jointplay.solver.mechanics.impact_floors import resting_rate
from jointplay.solver.mechanics.lagrange import LagrangeMechanism
from jointplay.solver.mechanics.motion import Motion
from jointplay.solver.mechanics.reduced import ReducedMechanism
from jointplay.solver.mechanics.start.states import start_state
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.mechanics.view import view
from jointplay.solver.scene import presets
from jointplay.solver.scene.clocks import clocks
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.pairs import contact_pairs


def preset(name: str, **parameters: float | str) -> Scene:
    """Return a preset's scene with parameters set."""
    scene = {"preset": name, "parameters": parameters}
    admission = admit({"kind": "simulate", "scene": scene, "duration": 1e-3})
    assert isinstance(admission, Admission)
    return Scene.model_validate(admission.scene)


def scene_of(document: Mapping[str, Any]) -> Scene:
    """Return the scene of a document that must be acceptable as it is."""
    return Scene.model_validate(dict(document))


def changed(name: str, **changes: Any) -> Scene:
    """Return a preset's scene with top-level fields replaced."""
    return scene_of({**presets.document(name), **changes})


@dataclass(frozen=True)
class Instant:
    """Everything that a scene's accelerations depend on, and how to evaluate them.

    `position`, `speed` by coordinate name; `driven` by driver; `mode` and `impact_rate` by joint
    with play.
    """

    scene: Scene
    position: dict[str, float]
    speed: dict[str, float]
    driven: dict[str, float]
    mode: dict[str, float]
    impact_rate: dict[str, float]

    def reduced(self) -> Motion:
        """Evaluate in joint coordinates."""
        mechanism = ReducedMechanism(
            spanning_tree(self.scene), view(self.scene), self.position, self.speed, self.driven
        )
        return mechanism.motion(self.mode, self.impact_rate)

    def absolute_state(self) -> tuple[list[float], list[float]]:
        """Return x, y, theta of every body in document order, and their rates."""
        bodies = self.reduced().bodies
        q = [x for name in self.scene.bodies for x in (*bodies[name].position, bodies[name].angle)]
        v = [x for name in self.scene.bodies for x in (*bodies[name].velocity, bodies[name].spin)]
        return q, v

    def lagrange(self) -> Motion:
        """Evaluate in absolute coordinates with multipliers, at the same state."""
        q, v = self.absolute_state()
        mechanism = LagrangeMechanism(self.scene, view(self.scene), q, v, self.driven)
        return mechanism.motion(self.mode, self.impact_rate)


def at_start(scene: Scene) -> Instant:
    """Return the assembled start of a scene, journals concentric."""
    tree, assembly = spanning_tree(scene), assemble(scene)
    state = start_state(scene, tree.coordinates, assembly.pose, assembly.velocity)
    position, speed = state.reshape(2, -1).tolist()
    return Instant(
        scene,
        dict(zip(tree.coordinates, position, strict=True)),
        dict(zip(tree.coordinates, speed, strict=True)),
        {name: clock.start for name, clock in clocks(scene).items()},
        dict.fromkeys(tree.pairs, 0.0),
        {
            name: resting_rate(scene, pair, shortest_link(scene))
            for name, pair in contact_pairs(scene).items()
        },
    )
