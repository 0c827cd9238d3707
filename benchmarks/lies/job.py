"""A random job: a scene, how long, by which method, how accurate."""

from typing import Any, NamedTuple

from benchmarks.lies.draw import Draw
from benchmarks.lies.scenes import EVERY, LOOSE, OTHERS
from jointplay.solver.integrators import METHODS
from jointplay.solver.kinds.job import ACCURACIES

SMALLEST = 1e-10
"""Tolerance."""
ANY = 1e-3
"""Largest tolerance of all."""


class Chosen(NamedTuple):
    """A random job, its kind of scene, and how many numbers it drew."""

    kind: str
    job: dict[str, Any]
    drawn: int


def random_job(point: list[float], kinds: list[str]) -> Chosen:
    """Return the job at a point of the unit cube."""
    draw = Draw(point)
    kind = draw.one_of(*kinds)
    method = draw.one_of("auto", "auto", *METHODS)
    fineness, length = draw.even(0.0, 1.0), draw.size(0.3, 20.0)
    scene, unit = EVERY[kind](draw)
    job = {"kind": "simulate", "scene": scene, "duration": unit * length, "method": method}
    if kind in LOOSE:
        accuracy = ACCURACIES[draw.one_of("draft", "standard", "standard", "fine")]
        job["method"], job["tolerance"] = accuracy
        return Chosen(kind, job, draw.count)
    if kind in OTHERS:
        job["formulation"] = draw.one_of("reduced", "reduced", "lagrange")
    if method in METHODS and METHODS[method].fixed_step:
        job["step"] = unit * 10.0 ** (-2.0 - 2.0 * fineness)
    else:
        largest = METHODS[method].largest_tolerance if method in METHODS else ANY
        job["tolerance"] = float(f"{largest * (SMALLEST / largest) ** fineness:.6g}")
    return Chosen(kind, job, draw.count)
