"""Floors under the impact rates that contacts latch: what a scene's own speeds make of them.

Laws that divide by the impact rate need one above zero, also where a contact begins at rest. A
floor that is far below the speeds of a scene leaves its impacts alone.
"""

from collections.abc import Sequence

from jointplay.solver.quantities.scalars import (
    Scalar,
    exact_sum,
    greatest,
    least,
    maximum,
    minimum,
    select_positive,
    sqrt,
)
from jointplay.solver.scene.clocks import turns
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.drivers import MovingDriver
from jointplay.solver.scene.pairs import ContactPair

SHARE = 1e-5
"""Share of a scene's speed below which the rate of an onset is not told from zero."""
LEAST, MOST = 1e-12, 1e-3
"""Bounds of floors that no law gives, m/s."""


def scene_speed(scene: Scene, play: Scalar, length: float) -> Scalar:
    """Return a speed of what a scene sets in motion about a joint with play, m/s; 0 at rest.

    The largest of √(2 a c), c the play, m, the speeds of drivers and motors, and those of the
    start; an angle's at a `length`, m. A polynomial's speed is that with which it crosses the play.
    a is what gravity and the full strength of all force elements accelerate the lightest body by,
    m/s^2.
    """
    forces = exact_sum([element.strength(length) for element in scene.forces.values()])
    lightest = least(body.mass for body in scene.bodies.values())
    speeds = [sqrt(2.0 * (_length(scene.gravity) + forces / lightest) * play)]
    for driver in scene.drivers.values():
        lever = length if turns(scene, driver) else 1.0
        if isinstance(driver, MovingDriver):
            speeds.append(lever * driver.motion.speed_within(play / lever))
        else:
            speeds.append(lever * abs(driver.clock_rate))
    speeds += [length * abs(element.fastest) for element in scene.forces.values()]
    start = scene.start
    speeds += [_length(velocity) for velocity in start.velocities.values()]
    speeds += [length * abs(spin) for spin in start.angular_velocities.values()]
    speeds += [_length(one.rate) for one in start.joints.values() if one.rate is not None]
    for guided in start.guides.values():
        speeds += [abs(guided.rate or 0.0), length * abs(guided.tilt_rate or 0.0)]
    return greatest(speeds)


def _length(vector: Sequence[Scalar]) -> Scalar:
    x, y = vector
    return sqrt(x * x + y * y)


def impact_floor(scene: Scene, pair: ContactPair, length: float) -> Scalar:
    """Return the floor of a pair, m/s: its law's, else a share of `scene_speed`; 0: no memory."""
    return _floor(scene, pair, length, SHARE)


def resting_rate(scene: Scene, pair: ContactPair, length: float) -> Scalar:
    """Return the least impact rate of a pair that touches from the start on, m/s.

    The law's floor, else the speed of the scene, at most `MOST`: the load that comes upon it is no
    impact.
    """
    return _floor(scene, pair, length, 1.0)


def _floor(scene: Scene, pair: ContactPair, length: float, share: float) -> Scalar:
    given = pair.clearance.contact.least_impact_rate
    if given is not None:
        return given
    speed = scene_speed(scene, pair.play, length)
    floor = minimum(maximum(share * speed, LEAST), MOST)
    return select_positive(speed, floor, MOST)
