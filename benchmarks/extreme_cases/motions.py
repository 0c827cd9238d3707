"""Ends of the ranges of what moves a mechanism, and of how long and how finely it is followed."""

import math
from collections.abc import Iterator
from typing import Any

from benchmarks.extreme_cases.case import CRANK, JOURNAL, PRESS, THROWN, Case
from jointplay.solver.scene import presets


def cases() -> Iterator[Case]:
    """Yield the cases."""
    yield from _speed()
    yield from _gravity()
    yield from _mass()
    yield from _dead_points()
    yield from _long_runs()
    yield from _fineness()


def plain(preset: str) -> dict[str, Any]:
    """Return a preset's document without what refers into it."""
    return presets.document(preset) | {"parameters": {}, "outputs": []}


def _speed() -> Iterator[Case]:
    for speed, duration in ((0.0, 0.5), (0.01, 0.5), (1.0, 0.5), (30.0, 0.1), (300.0, 0.05)):
        for signed in sorted({speed, -speed}, reverse=True):
            yield Case("speed", f"press, {signed:g} rad/s", PRESS, duration, {"speed": signed})
    for first, second in ((10.0, -20.0), (3.0, 0.0), (0.0, 40.0), (5.0, 7.07)):
        parameters = {"speed": first, "speed_crank4": second}
        yield Case("speed", f"press, {first:g} and {second:g} rad/s", PRESS, 0.3, parameters)


def _gravity() -> Iterator[Case]:
    for x, y in ((0.0, 0.0), (0.0, 9.81), (-9.81, 0.0), (6.9, -6.9), (1000.0, 0.0)):
        gravity = {"gravity_x": x, "gravity_y": y}
        name = f"({x:g}, {y:g}) m/s^2"
        yield Case("gravity", f"journal, {name}", JOURNAL, 0.1, THROWN | gravity)
        yield Case("gravity", f"press, {name}", PRESS, 0.2, gravity)


def _mass() -> Iterator[Case]:
    for mass in (1e-6, 1e6):
        parameters = {"mass": mass, "stiffness": 1e9 * mass}
        yield Case("mass", f"journal, {mass:g} kg", JOURNAL, 0.3, parameters)
    for heavy, light in (("slider7", "link2"), ("link2", "slider7")):
        scene = plain(PRESS)
        for body, factor in ((heavy, 1e3), (light, 1e-3)):
            for quantity in ("mass", "inertia"):
                scene["bodies"][body][quantity] *= factor
        yield Case("mass", f"press, {heavy} 1e6 times as heavy against {light}", scene, 0.1)


def _dead_points() -> Iterator[Case]:
    yield Case("dead points", "slider-crank, two revolutions", CRANK, 0.024)
    short = plain(CRANK)
    short["bodies"]["rod"]["points"] = {"crank": [-0.02, 0.0], "slider": [0.02, 0.0]}
    yield Case("dead points", "rod too short, with clearance", short, 0.003)
    ideal = plain(CRANK)
    ideal["bodies"]["rod"] = short["bodies"]["rod"]
    ideal["joints"]["P"]["clearance"]["radial_clearance"] = 0.0
    yield Case("dead points", "rod too short, ideal", ideal, 0.012)


def _long_runs() -> Iterator[Case]:
    resting = plain(CRANK)  # half of the rod's weight keeps it on the pin
    resting["gravity"], resting["drivers"]["motor"]["speed"] = [0.0, -9.81], 3.0
    revolution = 2.0 * math.pi / 3.0
    for count in (3, 1000):
        name = f"slider-crank, {count} revolutions"
        long = count > 100
        yield Case("resting contact", name, resting, count * revolution, long=long)
    for count in (10, 10_000):
        step, long = 2e-3 * count, count > 100
        yield Case(
            "long runs", f"press, {count} revolutions", PRESS, 2.0 * count, {}, 1e-6, step, long
        )


def _fineness() -> Iterator[Case]:
    for tolerance in (1e-2, 1e-3, 1e-4, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13):
        yield Case("tolerance", f"journal, {tolerance:g}", JOURNAL, 0.2, THROWN, tolerance)
        yield Case("tolerance", f"press, {tolerance:g}", PRESS, 0.1, {}, tolerance)
    yield Case("output step", "journal, longer than the run", JOURNAL, 0.05, output_step=10.0)
