"""Dead points: how the path of a driven mechanism ends, in words."""

import math

import numpy as np

from jointplay.records.failure import SimulationFailed
from jointplay.solver.runs.ideal.path import Path, Point
from jointplay.solver.scene.clocks import turns
from jointplay.solver.scene.document import Scene

SINGULAR = 1e-4
"""Share of the median singular value of the Jacobian below which the smallest is that of a dead
point."""
LOCKED = 1e-2
"""Share of the drivers' motion that works against the lock of a dead point, at least."""
TAKES_PART = 1e-3
MOST_NAMED = 4


def lost_at(path: Path, scene: Scene, time: float | None = None) -> SimulationFailed:
    """Return why a path ends where it does, or at a time before."""
    end = path.end
    at = end.time if time is None else time
    if not end.consistent:
        sentence = (
            f"The ideal mechanism cannot go on from t = {at:.6g} s: its redundant constraints do"
            " not agree. Remove a joint or a driver."
        )
        return SimulationFailed("assembly-lost", sentence, at)
    _, values, _ = np.linalg.svd(end.system.jacobian)
    if time is not None or values[-1] > SINGULAR * np.median(values):
        sentence = (
            f"The ideal mechanism cannot be followed past t = {at:.6g} s, where"
            f" {driven_to(scene, at)}: its links do not reach, or its drivers jump."
            " Change lengths, driver positions or speeds."
        )
        return SimulationFailed("assembly-lost", sentence, at)
    bodies = _names(_loose(end, list(scene.bodies)))
    beyond = (
        f"its links do not reach beyond ({bodies} lock)"
        if locks(end)
        else f"{bodies} may go on in more than one assembly"
    )
    sentence = (
        f"The ideal mechanism comes to a dead point at t = {at:.9g} s, where"
        f" {driven_to(scene, at)}: {beyond}."
        " Change lengths, driver positions or speeds, or end the run before."
    )
    return SimulationFailed("assembly-lost", sentence, at)


def elsewhere(periods: int, time: float) -> SimulationFailed:
    """Return that a mechanism is not back after some periods of its drivers, at a time in s."""
    sentence = (
        f"After {periods} periods of its drivers, {time:.6g} s, the ideal mechanism has not come"
        " back to the assembly of its start. Runs of it end there."
    )
    return SimulationFailed("assembly-lost", sentence, time)


def locks(end: Point) -> bool:
    """Return whether drivers work against the lock: else links may move while they stand."""
    left, _, _ = np.linalg.svd(end.system.jacobian, full_matrices=False)
    pushed = np.abs(left[:, -1] @ end.system.rate)
    return bool(pushed > LOCKED * np.linalg.norm(end.system.rate))


def _loose(end: Point, bodies: list[str]) -> list[str]:
    """Return the bodies that may still move while the drivers stand, most mobile first."""
    _, _, right = np.linalg.svd(end.system.jacobian, full_matrices=False)
    moved = np.abs(right[-1]).reshape(-1, 3).max(axis=1)
    order = [int(k) for k in np.argsort(-moved, kind="stable")]
    return [bodies[k] for k in order if moved[k] > TAKES_PART * moved.max()]


def _names(bodies: list[str]) -> str:
    shown = [f"'{body}'" for body in bodies[:MOST_NAMED]]
    if len(bodies) > MOST_NAMED:
        shown.append(f"{len(bodies) - MOST_NAMED} others")
    return " and ".join([", ".join(shown[:-1]), shown[-1]] if shown[1:] else shown)


def positions(scene: Scene, time: float) -> dict[str, float]:
    """Return where the drivers are at a time, rad or m."""
    return {
        name: float(driver.at(driver.clock_start + driver.clock_rate * time).value)
        for name, driver in scene.drivers.items()
    }


def driven_to(scene: Scene, time: float) -> str:
    """Return where the drivers are at a time, in words."""
    told = []
    for name, position in positions(scene, time).items():
        if turns(scene, scene.drivers[name]):
            told.append(f"'{name}' is at {position:.6g} rad ({math.degrees(position):.6g} deg)")
        else:
            told.append(f"'{name}' is at {position:.6g} m")
    return " and ".join(told)
