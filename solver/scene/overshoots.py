"""Smooth tables that leave the values they are given: what a check tells of them."""

from collections.abc import Iterator
from typing import NamedTuple

from jointplay.solver.laws.force.varying import Varying
from jointplay.solver.laws.function import Function
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.drivers import MovingDriver

NOTICED = 1e-2
"""Share of the range of a table's values below which nothing is said: a wave of 16 knots passes
those beside its top by as much, and rightly."""


class Overshoot(NamedTuple):
    """A table that passes the values on either side, most at an argument in its unit."""

    pointer: str
    percent: float
    """Distance, in hundredths of the range of all values."""
    argument: float
    detail: str


def overshoots(scene: Scene) -> list[Overshoot]:
    """Return the smooth tables of a scene that pass their values by a hundredth or more."""
    found = []
    for pointer, function, remedy in _functions(scene):
        share, argument = function.overshoot()
        if share >= NOTICED:
            detail = (
                f"Between its knots the smooth table passes its values by {100.0 * share:.2g} % of"
                f" their range, most at {argument:.6g}; {remedy}."
            )
            found.append(Overshoot(pointer, 100.0 * share, argument, detail))
    return found


def _functions(scene: Scene) -> Iterator[tuple[str, Function, str]]:
    """Yield the functions of a scene, each with what keeps it within its values."""
    pieces = "a 'piecewise-polynomial' can stay where it is, or give more knots"
    for name, joint in scene.joints.items():
        for field, function in joint.functions():
            yield f"/joints/{name}/{field}", function, pieces
    for name, driver in scene.drivers.items():
        if isinstance(driver, MovingDriver):
            yield f"/drivers/{name}/motion", driver.motion, pieces
    for name, element in scene.forces.items():
        if isinstance(element, Varying) and element.course is not None:
            yield f"/forces/{name}/course", element.course, "'monotone' stays within them"
