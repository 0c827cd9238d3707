"""Contact pairs push where the surfaces touch: virtual work against shapes drawn by themselves.

For every type of joint with play: the generalised force of a pair on both bodies is its normal
force times the gradient of the gap, plus its friction times the slip of the two surfaces where they
touch, each found from geometry alone.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from jointplay.solver.joints import JOINTS
from jointplay.solver.joints.contact import Contact
from jointplay.solver.laws.force import Ends
from jointplay.solver.mechanics.motion import forces_between
from jointplay.solver.mechanics.view import view
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.pairs import pairs_of
from tests.solver.mechanics import contact_shapes
from tests.solver.mechanics.contact_shapes import Array, Shape, Touch, turned
from tests.solver.readable_mechanics import scene_of

STEP = 1e-7
DEPTH = 1e-10
"""m: the surfaces are apart by as much, and so are the two positions."""
LAW = {"law": "lankarani-nikravesh", "stiffness": 1e15, "restitution": 0.5}
UNDAMPED = 1e6
"""Impact rate, m/s, beside which rates count for nothing, so that no pair lets go."""
RUBS = {"contact": LAW, "friction": {"coefficient": 0.4}}
WITH_PLAY = [kind for kind, joint in JOINTS.items() if "clearance" in joint.model_fields]
SHAPES: dict[str, Shape] = {
    "revolute": contact_shapes.journal,
    "prismatic": contact_shapes.corner,
    "pin-in-slot": contact_shapes.pin,
    "flat-follower": contact_shapes.face,
    "roller-follower": contact_shapes.roller,
}


@dataclass(frozen=True)
class Trial:
    """Two bodies that touch: the joint, a part of it, both poses and both velocities."""

    joint: dict[str, Any]
    part: str
    pose: Array
    velocity: Array

    def touch(self, pose: Array) -> Touch:
        here, there = (pose[i : i + 2] + turned(POINTS[i // 3], pose[i + 2]) for i in (0, 3))
        return SHAPES[self.joint["type"]](self.joint, self.part, here, pose[2], there, pose[5])


POINTS = ([0.03, -0.02], [-0.05, 0.04])
"""Positions of the joint's points on the bodies."""


def random(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high).map(lambda x: round(x, 6))


@st.composite
def joints(draw: st.DrawFn, kind: str) -> dict[str, Any]:
    """Draw the sizes of a joint: its play may be as large as what it is part of."""
    size = draw(random(0.02, 0.1))
    play = size * draw(random(0.01, 0.6))
    direction = turned([2.0, 0.0], draw(random(-3.0, 3.0))).tolist()
    if kind == "revolute":
        own = {"bearing": "one.P", "journal": "two.P"}
        return own | {"clearance": {"radial_clearance": play, "bearing_radius": size} | RUBS}
    if kind == "prismatic":
        own = {"guide": "one.P", "slider": "two.P", "axis": direction}
        own["angle"] = draw(random(-3.0, 3.0))
        block = {"wall_clearance": play, "length": 3.0 * size, "height": size}
        return own | {"clearance": block | RUBS}
    if kind == "pin-in-slot":
        own = {"slot": "one.P", "pin": "two.P", "axis": direction}
        return own | {"clearance": {"wall_clearance": play, "pin_radius": size} | RUBS}
    wave = size * draw(random(-0.25, 0.25))
    profile = {"type": "sinusoidal", "offset": size, "amplitude": wave, "frequency": 1.0}
    own = {"cam": "one.P", "follower": "two.P", "profile": profile}
    if kind == "flat-follower":
        return own | {"normal": direction, "clearance": {"lash": play} | RUBS}
    # exact to first order in the lash, unless the cam is round about its shaft
    lash = play if wave == 0.0 else 1e-8 * size
    return own | {"roller_radius": 0.2 * size, "clearance": {"lash": lash} | RUBS}


@st.composite
def trials(draw: st.DrawFn, kind: str) -> Trial:
    """Draw a joint, how its bodies lie so that one of its pairs touches, and how they move."""
    joint = {"type": kind} | draw(joints(kind))
    part = draw(st.sampled_from([pair.part for pair in pairs_of("J", scene(joint).joints["J"])]))
    pose = np.array([draw(random(-0.5, 0.5)) for _ in range(6)])
    pose[[2, 5]] = draw(random(-3.0, 3.0)), draw(random(-3.0, 3.0))
    if kind == "prismatic":
        pose[5] = pose[2] + joint["angle"] + draw(random(-0.4, 0.4))
    trial = Trial(joint, part, pose, np.array([draw(random(-2.0, 2.0)) for _ in range(6)]))
    for _ in range(2):
        found = trial.touch(pose)
        pose[3:5] += (found.gap + DEPTH) * found.normal
    return trial


def scene(joint: dict[str, Any]) -> Scene:
    """Return the scene of two bodies that a joint is between."""
    body = {"mass": 1.0, "inertia": 0.01}
    points = [{"points": {"P": list(position)}} for position in POINTS]
    bodies = {"one": body | points[0], "two": body | points[1]}
    return scene_of({"name": "pair", "bodies": bodies, "joints": {"J": joint}})


def contact(trial: Trial, pose: Array) -> Contact:
    """Return what the mechanics make of the pair, in a pose that need not be the trial's."""
    numbers = scene(trial.joint)
    name = f"J.{trial.part}" if trial.part else "J"

    def ends(_first: str, _second: str) -> Ends:
        moved = []
        for i, point in zip((0, 3), POINTS, strict=True):
            arm, spin = turned(point, pose[i + 2]), trial.velocity[i + 2]
            moved.append((pose[i : i + 2] + arm, trial.velocity[i : i + 2] + spin * LEFT @ arm))
        (here, slow), (there, fast) = moved
        angles = pose[2], pose[5]
        return Ends(
            tuple(there - here),
            tuple(fast - slow),
            (trial.velocity[2], trial.velocity[5]),
            tuple((np.cos(a), np.sin(a)) for a in angles),
            angles,
        )

    pairs = [pair.name for pair in pairs_of("J", numbers.joints["J"])]
    rates, modes = dict.fromkeys(pairs, UNDAMPED), dict.fromkeys(pairs, 1.0)
    return forces_between(view(numbers), ends, {}, ["J"], modes, rates).contacts[name]


LEFT = np.array([[0.0, -1.0], [1.0, 0.0]])


def gradient(trial: Trial) -> Array:
    """Return the derivatives of the gap by x, y and angle of both bodies, by differences."""
    found = []
    for step in STEP * np.eye(6):
        after, before = (trial.touch(trial.pose + sense * step).gap for sense in (1.0, -1.0))
        found.append((after - before) / (2.0 * STEP))
    return np.array(found)


def slips(trial: Trial) -> Array:
    """Return the slip of the second surface on the first that a rate of each of these gives."""
    found = trial.touch(trial.pose)
    along = LEFT @ found.normal
    arms = [position - trial.pose[i : i + 2] for i, position in ((0, found[1]), (3, found[2]))]
    (first, second) = ([*along, along @ LEFT @ arm] for arm in arms)
    return np.array([*(-np.array(first)), *second])


def generalised(trial: Trial, found: Contact) -> Array:
    """Return the force on x, y and angle of both bodies."""
    acting = found.interaction
    force = np.array(acting.force_on_second)
    first, second = (
        turned(point, trial.pose[i + 2]) for i, point in zip((0, 3), POINTS, strict=True)
    )
    on_first = acting.moment_on_first - LEFT @ first @ force
    return np.array([*-force, on_first, *force, acting.moment_on_second + LEFT @ second @ force])


@pytest.mark.parametrize("kind", WITH_PLAY)
@settings(max_examples=40)
@given(data=st.data())
def test_a_pair_pushes_and_rubs_where_the_surfaces_touch(kind: str, data: st.DataObject) -> None:
    trial = data.draw(trials(kind))
    found, slope, slip = contact(trial, trial.pose), gradient(trial), slips(trial)
    assert found.penetration == pytest.approx(DEPTH, abs=1e-14)
    assert found.penetration_rate == pytest.approx(-float(slope @ trial.velocity), abs=2e-7)
    assert found.slip_velocity == pytest.approx(float(slip @ trial.velocity), abs=2e-7)
    assert found.normal_force > 0.0
    expected = found.normal_force * slope + found.friction_force * slip
    size = found.normal_force
    np.testing.assert_allclose(generalised(trial, found) / size, expected / size, atol=2e-7)
