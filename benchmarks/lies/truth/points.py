"""Positions and velocities of points of bodies, and forces on them."""

import math

from benchmarks.lies.truth.compiled import compiled, compiled_inside
from benchmarks.lies.truth.mechanism import Floats, Mechanism


@compiled
def point(m: Mechanism, p: int, y: Floats) -> tuple[float, ...]:
    """Return arm, position and velocity of a point, world components, and its body's spin."""
    body = m.body[p]
    if body < 0:
        return 0.0, 0.0, m.arm[p, 0], m.arm[p, 1], 0.0, 0.0, 0.0
    half = len(y) // 2
    angle, spin = y[3 * body + 2], y[half + 3 * body + 2]
    cosine, sine = math.cos(angle), math.sin(angle)
    ax = cosine * m.arm[p, 0] - sine * m.arm[p, 1]
    ay = sine * m.arm[p, 0] + cosine * m.arm[p, 1]
    vx = y[half + 3 * body] - spin * ay
    vy = y[half + 3 * body + 1] + spin * ax
    return ax, ay, y[3 * body] + ax, y[3 * body + 1] + ay, vx, vy, spin


@compiled_inside
def push(m: Mechanism, p: int, y: Floats, fx: float, fy: float, load: Floats) -> None:
    """Add a force on a point to the generalised forces."""
    body = m.body[p]
    if body < 0:
        return
    ax, ay, _, _, _, _, _ = point(m, p, y)
    load[3 * body] += fx
    load[3 * body + 1] += fy
    load[3 * body + 2] += ax * fy - ay * fx
