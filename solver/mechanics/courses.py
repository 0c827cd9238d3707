"""Arguments of forces that vary: time, a driver's position, how two points lie, or rates."""

from collections.abc import Callable, Mapping

from jointplay.solver.laws.force import Ends, ForceElement, Over
from jointplay.solver.laws.force.distance import distance
from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.scene.document import Scene

EndsOf = Callable[[str, str], Ends]
"""Tells how the second of two named points lies and moves against the first."""


def acting_between(numbers: Scene, name: str, ends: EndsOf, clocks: Mapping[str, Scalar]) -> Ends:
    """Return the ends of a force element, with its argument where it varies.

    `clocks` by driver, and by element that varies with time.
    """
    element = numbers.forces[name]
    between, over = ends(element.first, element.second), element.follows()
    if over is None:
        return between
    if over.quantity == "time":
        return between._replace(argument=clocks[name])
    if over.quantity == "driver":
        assert over.driver is not None  # noqa: S101  (narrows the type; checked with the scene)
        moved = numbers.drivers[over.driver].at(clocks[over.driver])
        value, rate = moved.value, moved.slope
    else:
        value, rate = _between_points(element, over, ends)
    if over.rate:
        return between._replace(argument=rate)
    return between._replace(argument=value, argument_rate=rate)


def _between_points(element: ForceElement, over: Over, ends: EndsOf) -> tuple[Scalar, Scalar]:
    found = ends(over.first or element.first, over.second or element.second)
    (x, y), (vx, vy) = found.gap, found.rate
    if over.quantity == "angle":
        return found.angles[1] - found.angles[0], found.spins[1] - found.spins[0]
    if over.quantity == "distance":
        apart = distance(found)
        return apart.length, apart.rate
    return (x, vx) if over.quantity == "x" else (y, vy)
