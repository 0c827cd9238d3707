"""Ends of the ranges of a joint's numbers: its clearance, its contact, its friction."""

import math
from collections.abc import Iterator

from benchmarks.extreme_cases.case import JOURNAL, PRESS, THROWN, Case

HERTZ = {"stiffness": 5e9}
"""Parameters of the press, so that its clearance may vary alone."""


def cases() -> Iterator[Case]:
    """Yield the cases."""
    yield from _clearance()
    yield from _contact()
    yield from _friction()


def _clearance() -> Iterator[Case]:
    for c in (1e-9, 1e-6, 1e-4, 5e-3):
        fall = math.sqrt(2.0 * c / 9.81)
        yield Case("clearance", f"journal, {c:g} m", JOURNAL, 100.0 * fall, {"clearance": c})
    for c in (1e-8, 1e-6, 1e-5, 5e-3):
        parameters = HERTZ | {"clearance": c, "bearing_radius": 0.01}
        yield Case("clearance", f"press, {c:g} m", PRESS, 0.2, parameters)


def _contact() -> Iterator[Case]:
    for k in (1e6, 1e8, 1e10, 1e13):
        yield Case("stiffness", f"journal, {k:g} N/m^1.5", JOURNAL, 0.3, {"stiffness": k})
        yield Case("stiffness", f"press, {k:g} N/m^1.5", PRESS, 0.1, {"stiffness": k})
    for n, k in ((1.0, 1e6), (1.0, 1e13), (1.2, 1e8), (2.0, 1e12), (3.0, 1e17)):
        parameters = {"exponent": n, "stiffness": k, "friction": 0.0}
        yield Case("exponent", f"journal, {n:g} with {k:g} N/m^n", JOURNAL, 0.3, parameters)
    for e in (0.0, 0.01, 1.0):
        yield Case("restitution", f"journal, {e:g}", JOURNAL, 0.3, {"restitution": e})
        yield Case("restitution", f"press, {e:g}", PRESS, 0.2, {"restitution": e})


def _friction() -> Iterator[Case]:
    yield Case("friction", "journal, 0", JOURNAL, 0.3, THROWN | {"friction": 0.0})
    for mu in (1e-6, 0.5, 2.0):
        yield Case("friction", f"journal, {mu:g}", JOURNAL, 0.3, THROWN | {"friction": mu})
        yield Case("friction", f"press, {mu:g}", PRESS, 0.2, {"friction": mu})
    for name, static, dynamic in (
        ("v0 = v1 = 1e-3 m/s", 1e-3, 1e-3),
        ("v1 = 1e-5 m/s", 0.0, 1e-5),
        ("v1 = 1e-7 m/s", 0.0, 1e-7),
    ):
        steep = {"static_velocity": static, "dynamic_velocity": dynamic, "friction": 0.1}
        long = dynamic < 1e-6
        yield Case("friction", f"journal, {name}", JOURNAL, 0.3, THROWN | steep, long=long)
        yield Case("friction", f"press, {name}", PRESS, 0.2, steep, long=long)
