"""The spanning tree of a scene: which joint carries which body, and what moves freely.

Pure structure: no number of the scene is used but whether a clearance is zero.
"""

from dataclasses import dataclass
from typing import Literal

from jointplay.solver.joints import Joint
from jointplay.solver.joints.joint import Freedom
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.pairs import contact_pairs
from jointplay.solver.scene.structure import per_structure

CARRYING: tuple[Freedom, ...] = ("turn", "slide", "none")
"""Freedoms of joints that carry a body."""


@dataclass(frozen=True)
class Branch:
    """A body, the joint that carries it, and the coordinates that this joint frees.

    `freedom` is that of the joint, or all of a body that none carries. `outward` tells whether the
    body is the joint's second one (journal, slider, part).
    `coordinates` are names of generalised coordinates, ``body.theta``, ``body.s``, ``body.x`` or
    ``body.y``; `driver` names the driver that prescribes the joint's motion instead, `turned_by`
    the one that prescribes the body's angle against the ground, whatever its joint.
    """

    body: str
    parent: str
    joint: str
    freedom: Freedom | Literal["all"]
    parent_point: str
    body_point: str
    outward: bool
    coordinates: tuple[str, ...]
    driver: str | None
    turned_by: str | None = None


@dataclass(frozen=True)
class Tree:
    """Branches from the ground outwards, what closes loops, joints with play, their pairs.

    Loops are closed by joints, and by gears.
    """

    branches: tuple[Branch, ...]
    closing: tuple[str, ...]
    play: tuple[str, ...]
    pairs: tuple[str, ...]

    @property
    def coordinates(self) -> tuple[str, ...]:
        """Names of the generalised coordinates, in the order of the state."""
        return tuple(c for branch in self.branches for c in branch.coordinates)

    def branch(self, body: str) -> Branch:
        """Return the branch that ends in a body."""
        return next(b for b in self.branches if b.body == body)


@per_structure
def spanning_tree(scene: Scene) -> Tree:
    """Walk the ideal joints from the ground, breadth first, in the order of the document.

    A body that ideal joints do not connect to the ground floats: it gets x, y and theta.
    """
    drivers = {driver.joint: name for name, driver in scene.drivers.items() if driver.joint}
    turning = {driver.body: name for name, driver in scene.drivers.items() if driver.body}
    ideal = {name: joint for name, joint in scene.joints.items() if not joint.has_play}
    branches: list[Branch] = []
    used: set[str] = set()
    reached = ["ground"]
    waiting = list(scene.bodies)
    position = 0
    while True:
        while position < len(reached):
            parent = reached[position]
            position += 1
            for name, joint in ideal.items():
                if joint.freedom not in CARRYING:  # they hold a body less than needed
                    continue
                sides = [point.split(".") for point in joint.points]
                if name in used or parent not in (sides[0][0], sides[1][0]):
                    continue
                outward = sides[0][0] == parent
                here, there = sides if outward else sides[::-1]
                if there[0] in reached:
                    continue
                turned_by = turning.get(there[0])
                driver = drivers.get(name)
                if turned_by and driver:  # it closes a loop: no branch has both motions
                    continue
                used.add(name)
                if turned_by and here[0] == "ground" and outward and joint.freedom == "turn":
                    driver, turned_by = turned_by, None  # the joint's angle is the body's
                reached.append(there[0])
                branches.append(
                    Branch(
                        body=there[0],
                        parent=parent,
                        joint=name,
                        freedom=joint.freedom,
                        parent_point=here[1],
                        body_point=there[1],
                        outward=outward,
                        coordinates=_coordinates(there[0], joint, driver or turned_by),
                        driver=driver,
                        turned_by=turned_by,
                    )
                )
        waiting = [body for body in waiting if body not in reached]
        if not waiting:
            break
        root = waiting[0]
        reached.append(root)
        turned_by = turning.get(root)
        freedom = (f"{root}.x", f"{root}.y", *([] if turned_by else [f"{root}.theta"]))
        branches.append(Branch(root, "ground", "", "all", "", "", True, freedom, None, turned_by))
    closing = (*(name for name in ideal if name not in used), *scene.gears)
    play = tuple(name for name, joint in scene.joints.items() if joint.has_play)
    return Tree(tuple(branches), closing, play, tuple(contact_pairs(scene)))


def _coordinates(body: str, joint: Joint, driver: str | None) -> tuple[str, ...]:
    if driver is not None or joint.freedom == "none":
        return ()
    return (f"{body}.theta",) if joint.freedom == "turn" else (f"{body}.s",)
