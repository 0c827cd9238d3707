"""Contacts of joints with play: journals, corners and pins at walls, flat faces at cams."""

import math

from benchmarks.lies.truth.compiled import compiled_inside
from benchmarks.lies.truth.mechanism import ARM, EDGE, KIND, Floats, Mechanism
from benchmarks.lies.truth.pairs import CAM, CIRCLE
from benchmarks.lies.truth.points import point, push

GAP, GAP_RATE, NORMAL_FORCE, FRICTION, SLIP, EX, EY, VX, VY, SEEN, DAMPING = range(11)
"""Channels of a joint with play: penetration (m) and its rate, forces (N), slip velocity,
eccentricity and its rate, the slip that friction sees, the factor of damping on the force."""
DX, DY, RX, RY = range(11, 15)
"""Where a wall or a cam is touched: from the first point, and from the second, m."""
TOLD = 15


@compiled_inside
def resist(
    m: Mechanism,
    j: int,
    gap: float,
    rate: float,
    seen: float,
    closed: bool,
    impact: float,
    told: Floats,
) -> None:
    """Fill in the forces of a contact; `seen` is the slip that friction sees."""
    normal, friction, damping = 0.0, 0.0, 1.0
    if closed:
        damping = 1.0 + m.law[j, 4] * rate / impact
        if gap > 0.0 and damping > 0.0:
            normal = m.law[j, 2] * gap ** m.law[j, 3] * damping
        low, high = m.law[j, 7], m.law[j, 8]
        share = 1.0 if abs(seen) > low else 0.0
        if high > low:
            share = min(max((abs(seen) - low) / (high - low), 0.0), 1.0)
        friction = -math.copysign(m.law[j, 6] * share * normal, seen)
    told[GAP], told[GAP_RATE], told[NORMAL_FORCE], told[FRICTION] = gap, rate, normal, friction
    told[SEEN], told[DAMPING] = seen, damping


@compiled_inside
def touch_surface(
    m: Mechanism, j: int, y: Floats, closed: bool, impact: float, told: Floats
) -> None:
    """Evaluate the contact of a corner or a pin at a straight wall, or of a flat face at its cam.

    In place of the eccentricity the normal from the second body into the first is told, and the
    rate along it.
    """
    _, _, bx, by, bvx, bvy, first_spin = point(m, m.play[j, 0], y)
    _, _, px, py, pvx, pvy, spin = point(m, m.play[j, 1], y)
    is_cam = m.wall[j, KIND] == CAM
    carrier, cam = m.body[m.play[j, 1 if is_cam else 0]], m.body[m.play[j, 0]]
    angle = y[3 * carrier + 2] if carrier >= 0 else 0.0
    nx = math.cos(angle) * m.wall[j, 0] - math.sin(angle) * m.wall[j, 1]
    ny = math.sin(angle) * m.wall[j, 0] + math.cos(angle) * m.wall[j, 1]
    gap = nx * (px - bx) + ny * (py - by) - m.wall[j, EDGE] - m.law[j, 0]
    dx, dy = px + m.wall[j, ARM] * nx - bx, py + m.wall[j, ARM] * ny - by
    if is_cam:  # its profile is a support function over the direction of the face's normal
        mean, swing, times, phase = m.cam[j]
        over = times * (math.atan2(-ny, -nx) - (y[3 * cam + 2] if cam >= 0 else 0.0)) + phase
        lift, slope = mean + swing * math.sin(over), swing * times * math.cos(over)
        gap += lift
        dx, dy = -(lift - m.law[j, 0]) * nx + slope * ny, -(lift - m.law[j, 0]) * ny - slope * nx
    rx, ry = bx + dx - px, by + dy - py
    vx, vy = pvx - spin * ry - bvx + first_spin * dy, pvy + spin * rx - bvy - first_spin * dx
    rate, slip = nx * vx + ny * vy, nx * vy - ny * vx
    resist(m, j, gap, rate, slip, closed, impact, told)
    told[SLIP] = slip
    told[EX], told[EY], told[VX], told[VY] = nx, ny, rate * nx, rate * ny
    told[DX], told[DY], told[RX], told[RY] = dx, dy, rx, ry


@compiled_inside
def touch(m: Mechanism, j: int, y: Floats, closed: bool, impact: float, told: Floats) -> None:
    """Evaluate the contact of a joint with play: eqs 2 to 17 of the press paper."""
    if m.wall[j, KIND] != CIRCLE:
        touch_surface(m, j, y, closed, impact, told)
        return
    _, _, bx, by, bvx, bvy, bearing_spin = point(m, m.play[j, 0], y)
    _, _, jx, jy, jvx, jvy, journal_spin = point(m, m.play[j, 1], y)
    clearance, radius = m.law[j, 0], m.law[j, 1]
    ex, ey, vx, vy = jx - bx, jy - by, jvx - bvx, jvy - bvy
    distance = math.hypot(ex, ey)
    nx = ex / distance if distance > 0.0 else 0.0
    ny = ey / distance if distance > 0.0 else 0.0
    gap, rate = distance - clearance, vx * nx + vy * ny
    around = vy * nx - vx * ny
    slip = around + (radius - clearance) * journal_spin - radius * bearing_spin
    seen = slip
    if m.law[j, 9] > 0.0:
        seen = around - clearance * (around / distance if distance > 0.0 else 0.0)
    resist(m, j, gap, rate, seen, closed, impact, told)
    told[SLIP] = slip
    told[EX], told[EY], told[VX], told[VY] = ex, ey, vx, vy


@compiled_inside
def load_play(m: Mechanism, j: int, y: Floats, told: Floats, load: Floats) -> None:
    """Add the forces of a contact, where the surfaces touch."""
    distance = math.hypot(told[EX], told[EY])
    if distance == 0.0:
        return
    nx, ny = told[EX] / distance, told[EY] / distance
    fx = -told[NORMAL_FORCE] * nx - told[FRICTION] * ny
    fy = -told[NORMAL_FORCE] * ny + told[FRICTION] * nx
    first, second = m.play[j, 0], m.play[j, 1]
    push(m, second, y, fx, fy, load)
    push(m, first, y, -fx, -fy, load)
    on_second = (m.law[j, 1] - m.law[j, 0]) * told[FRICTION]
    on_first = -m.law[j, 1] * told[FRICTION]
    if m.wall[j, KIND] != CIRCLE:
        on_second, on_first = told[RX] * fy - told[RY] * fx, told[DY] * fx - told[DX] * fy
    if m.body[second] >= 0:
        load[3 * m.body[second] + 2] += on_second
    if m.body[first] >= 0:
        load[3 * m.body[first] + 2] += on_first
