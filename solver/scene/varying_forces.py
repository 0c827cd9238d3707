"""Checks of forces that vary: what they name must exist, and fit what they are functions of."""

import math
from collections.abc import Iterator

from jointplay.records.failure import Problem
from jointplay.records.suggestions import unknown
from jointplay.solver.laws.force import Over
from jointplay.solver.laws.force.varying import FULL_RATE, Varying
from jointplay.solver.laws.function.whole_turn import repeats_every_turn
from jointplay.solver.scene.clocks import turns
from jointplay.solver.scene.document import Scene

POINTS = frozenset({"angle", "distance", "x", "y"})


def varying_problems(scene: Scene) -> Iterator[Problem]:
    """Yield what is wrong with the courses of forces; pointers begin at the scene."""
    for name, element in scene.forces.items():
        if not isinstance(element, Varying):
            continue
        if element.only is None and element.full_rate != FULL_RATE:
            sentence = (
                "A force that acts at all rates has no 'full_rate'; give 'only', or leave it out."
            )
            yield Problem(f"/forces/{name}/full_rate", sentence)
        over = element.follows()
        if over is not None:
            yield from _over(scene, f"/forces/{name}", element, over)
        elif element.over is not None:
            yield Problem(
                f"/forces/{name}/over",
                "A force without 'course' and 'only' does not vary; give one, or leave this out.",
            )


def _over(scene: Scene, pointer: str, element: Varying, over: Over) -> Iterator[Problem]:
    for field, given in (("driver", over.driver), ("first", over.first), ("second", over.second)):
        fits = over.quantity == "driver" if field == "driver" else over.quantity in POINTS
        if given is not None and not fits:
            sentence = f"A function of {over.quantity} has no '{field}'; leave it out."
            yield Problem(f"{pointer}/over/{field}", sentence)
    if element.only is not None and (over.quantity == "time" or over.rate):
        yield Problem(
            f"{pointer}/only",
            f"What acts while something is {element.only} is a function of that: a driver's"
            " position, or how two points lie; say of which in 'over'.",
        )
    if over.quantity == "time" and over.rate:
        yield Problem(f"{pointer}/over/rate", "Time has no rate; leave it out.")
    if over.quantity == "driver":
        yield from _driver(scene, pointer, element, over)


def is_over_turns(scene: Scene, element: Varying) -> bool:
    """Return whether an element's course is a function of the angle of a driver that turns."""
    over = element.follows()
    if element.course is None or over is None or over.quantity != "driver" or over.rate:
        return False
    driver = scene.drivers.get(over.driver or "")
    return driver is not None and turns(scene, driver)


def _driver(scene: Scene, pointer: str, element: Varying, over: Over) -> Iterator[Problem]:
    if over.driver is None or over.driver not in scene.drivers:
        sentence = "Name the driver." if over.driver is None else ""
        sentence = sentence or unknown("driver", over.driver or "", scene.drivers)
        yield Problem(f"{pointer}/over/driver", sentence)
        return
    if element.course is None or not is_over_turns(scene, element):
        return
    if not repeats_every_turn(element.course):
        period = element.course.period
        after = "does not repeat" if math.isinf(period) else f"repeats after {period:.9g} rad"
        yield Problem(
            f"{pointer}/course",
            f"A force over the angle of driver '{over.driver}' repeats every turn,"
            f" {2.0 * math.pi:.9g} rad; this course {after}. Give a periodic one whose knots end a"
            " turn, or a whole part of it.",
        )
