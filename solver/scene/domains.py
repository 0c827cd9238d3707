"""Arguments that a function refuses: found on admission, where a run's length tells them."""

from collections.abc import Iterator

from jointplay.records.failure import Problem
from jointplay.solver.laws.force.varying import Varying
from jointplay.solver.laws.function import Function
from jointplay.solver.laws.function.knots import SLACK
from jointplay.solver.scene.clocks import clocks, timed
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.drivers import MovingDriver, SteadyDriver


def domain_problems(scene: Scene, duration: float) -> Iterator[Problem]:
    """Yield what a run of a duration, s, surely asks of functions that refuse it."""
    for name, driver in scene.drivers.items():
        if isinstance(driver, MovingDriver):
            pointer = f"/scene/drivers/{name}/motion/knots"
            yield from _over(pointer, driver.motion, (0.0, duration), "time, s,")
    for name, varying in timed(scene).items():
        if varying.course is not None:
            pointer = f"/scene/forces/{name}/course/knots"
            yield from _over(pointer, varying.course, (0.0, duration), "time, s,")
    for name, element in scene.forces.items():
        over = element.follows()
        if not isinstance(element, Varying) or element.course is None or over is None:
            continue
        moving = scene.drivers.get(over.driver or "")
        if isinstance(moving, SteadyDriver) and not over.rate:
            clock = clocks(scene)[over.driver or ""]
            travel = sorted((clock.start, clock.start + clock.rate * duration))
            pointer = f"/scene/forces/{name}/course/knots"
            yield from _over(pointer, element.course, (travel[0], travel[1]), f"'{over.driver}'")


def _over(
    pointer: str, function: Function, needed: tuple[float, float], what: str
) -> Iterator[Problem]:
    if function.domain is None:
        return
    (first, last), (low, high) = function.domain, needed
    slack = SLACK * (last - first)
    if first - low > slack or high - last > slack:
        way = f"goes from {low:g} to {high:g}" if low < high else f"begins at {low:g}"
        yield Problem(
            pointer,
            f"It is given from {first:g} to {last:g}, but {what} {way}, and"
            " others are refused. Give more knots, a shorter duration, or another 'outside'.",
        )


def bounded_motions(scene: Scene) -> list[tuple[str, Function]]:
    """Return the motions of drivers, with their names, that refuse some times."""
    return [
        (name, driver.motion)
        for name, driver in scene.drivers.items()
        if isinstance(driver, MovingDriver) and driver.motion.domain
    ]


def bounded_courses(scene: Scene) -> dict[str, Function]:
    """Return the courses, by force, that refuse some arguments."""
    return {
        name: element.course
        for name, element in scene.forces.items()
        if isinstance(element, Varying) and element.course and element.course.domain
    }
