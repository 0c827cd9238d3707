"""Facts that are found once of the latest scene: never one scene's for another's."""

import threading

import pytest

from jointplay.solver.mechanics.assembly import assemble, shortest_link
from jointplay.solver.scene import presets
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.once_per_scene import once_per_scene


def test_a_scene_is_looked_at_once_by_each_thread_until_another_comes():
    seen = []

    @once_per_scene
    def fact(scene):
        seen.append(scene)
        return len(seen)

    assert [fact("a"), fact("a"), fact("b"), fact("b"), fact("a")] == [1, 1, 2, 2, 3]
    other = threading.Thread(target=fact, args=["a"])
    other.start()
    other.join()
    assert seen == ["a", "b", "a", "a"]
    assert fact("a") == 3


def test_a_scene_that_cannot_be_looked_at_leaves_the_one_before():
    @once_per_scene
    def fact(scene):
        if scene == "wrong":
            raise ValueError(scene)
        return object()

    before = fact("right")
    for _ in range(2):
        with pytest.raises(ValueError, match="wrong"):
            fact("wrong")
    assert fact("right") is before


def test_changed_copies_of_a_scene_have_facts_of_their_own():
    scene = Scene.model_validate(presets.document("slider-crank"))
    first, pose = shortest_link(scene), assemble(scene).pose
    crank = scene.bodies["crank"]
    longer = {name: [1.5 * x for x in position] for name, position in crank.points.items()}
    bodies = scene.bodies | {"crank": crank.model_copy(update={"points": longer})}
    changed = scene.model_copy(update={"bodies": bodies})
    assert shortest_link(changed) != first
    assert (assemble(changed).pose != pose).any()
    assert (shortest_link(scene), (assemble(scene).pose == pose).all()) == (first, True)
