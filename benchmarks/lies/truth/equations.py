"""Newton's and Euler's equations with multipliers: M a = f + Jᵀ λ, J a = γ.

The state is (6 bodies,): x, y (m) and angle (rad) of each body, then their rates.
"""

import math

import numpy as np

from benchmarks.lies.truth.compiled import compiled, compiled_inside
from benchmarks.lies.truth.contacts import load_play, touch
from benchmarks.lies.truth.mechanism import ACROSS_X, ACROSS_Y, ANGLE, NORMAL, Floats, Mechanism
from benchmarks.lies.truth.points import point, push


@compiled
def stretch(m: Mechanism, s: int, y: Floats) -> tuple[float, float, float, float, float]:
    """Return length, its rate, tension and direction of a spring with damper."""
    _, _, px, py, pvx, pvy, _ = point(m, m.spring[s, 0], y)
    _, _, qx, qy, qvx, qvy, _ = point(m, m.spring[s, 1], y)
    dx, dy = qx - px, qy - py
    length = math.hypot(dx, dy)
    ux = dx / length if length > 0.0 else 0.0
    uy = dy / length if length > 0.0 else 0.0
    rate = ux * (qvx - pvx) + uy * (qvy - pvy)
    tension = m.spring_law[s, 0] * (length - m.spring_law[s, 2]) + m.spring_law[s, 1] * rate
    return length, rate, tension, ux, uy


@compiled
def driven(m: Mechanism, r: int, t: float) -> tuple[float, float, float]:
    """Return what a driver prescribes at a time: position, speed and acceleration."""
    amplitude, frequency = m.motion[r, 4], m.motion[r, 5]
    at = frequency * t + m.motion[r, 6]
    return (
        m.motion[r, 0] + m.motion[r, 1] * t + amplitude * math.sin(at),
        m.motion[r, 1] + amplitude * frequency * math.cos(at),
        -amplitude * frequency * frequency * math.sin(at),
    )


@compiled
def turn(m: Mechanism, s: int, y: Floats) -> tuple[float, float]:
    """Return a motor's moment on its rotor, and the speed of that against the stator."""
    _, _, _, _, _, _, stator = point(m, m.motor[s, 0], y)
    _, _, _, _, _, _, rotor = point(m, m.motor[s, 1], y)
    speed = rotor - stator
    return m.motor_law[s, 0] * (1.0 - speed / m.motor_law[s, 1]), speed


@compiled_inside
def constrain(
    m: Mechanism, t: float, y: Floats, jacobian: Floats, off: Floats, drift: Floats, gamma: Floats
) -> None:
    """Fill in the constraints: Jacobian, what they are off by, its rate, and γ."""
    jacobian[:] = 0.0
    for r in range(len(m.row)):
        kind, first, second = m.row[r]
        position, speed, acceleration = driven(m, r, t)
        fax, fay, fx, fy, fvx, fvy, first_spin = point(m, first, y)
        sax, say, sx, sy, svx, svy, second_spin = point(m, second, y)
        here, there = m.body[first], m.body[second]
        if kind == ANGLE:
            value, rate = -position, -speed
            if there >= 0:
                jacobian[r, 3 * there + 2] += 1.0
                value, rate = value + y[3 * there + 2], rate + second_spin
            if here >= 0:
                jacobian[r, 3 * here + 2] -= 1.0
                value, rate = value - y[3 * here + 2], rate - first_spin
            off[r], drift[r], gamma[r] = value, rate, acceleration
            continue
        dx, dy, dvx, dvy = sx - fx, sy - fy, svx - fvx, svy - fvy
        carried = 0.0  # spin of the direction along which the distance is taken
        if kind == ACROSS_X:
            wx, wy, position, speed, acceleration = 1.0, 0.0, 0.0, 0.0, 0.0
        elif kind == ACROSS_Y:
            wx, wy, position, speed, acceleration = 0.0, 1.0, 0.0, 0.0, 0.0
        else:
            angle = y[3 * here + 2] if here >= 0 else 0.0
            carried = first_spin
            ux = math.cos(angle) * m.motion[r, 2] - math.sin(angle) * m.motion[r, 3]
            uy = math.sin(angle) * m.motion[r, 2] + math.cos(angle) * m.motion[r, 3]
            wx, wy = ux, uy
            if kind == NORMAL:
                wx, wy = -uy, ux
        px, py = -wy, wx  # the rate of the direction, per spin
        off[r] = wx * dx + wy * dy - position
        drift[r] = wx * dvx + wy * dvy + carried * (px * dx + py * dy) - speed
        bias_x = -second_spin * second_spin * sax + first_spin * first_spin * fax
        bias_y = -second_spin * second_spin * say + first_spin * first_spin * fay
        gamma[r] = acceleration - (wx * bias_x + wy * bias_y)
        gamma[r] -= 2.0 * carried * (px * dvx + py * dvy)
        gamma[r] += carried * carried * (wx * dx + wy * dy)
        if there >= 0:
            jacobian[r, 3 * there] += wx
            jacobian[r, 3 * there + 1] += wy
            jacobian[r, 3 * there + 2] += wy * sax - wx * say
        if here >= 0:
            jacobian[r, 3 * here] -= wx
            jacobian[r, 3 * here + 1] -= wy
            jacobian[r, 3 * here + 2] -= wy * fax - wx * fay
            if kind > ANGLE:
                jacobian[r, 3 * here + 2] += px * dx + py * dy


@compiled_inside
def solve(system: Floats, right: Floats) -> bool:
    """Solve a symmetric positive system in place; whether it is one."""
    count = len(right)
    largest = 0.0
    for i in range(count):
        largest = max(largest, system[i, i])
    for i in range(count):
        for j in range(i + 1):
            total = system[i, j]
            for k in range(j):
                total -= system[i, k] * system[j, k]
            if i == j:
                if not total > 1e-14 * largest:
                    return False
                system[i, i] = math.sqrt(total)
            else:
                system[i, j] = total / system[j, j]
    for i in range(count):
        for k in range(i):
            right[i] -= system[i, k] * right[k]
        right[i] /= system[i, i]
    for i in range(count - 1, -1, -1):
        for k in range(i + 1, count):
            right[i] -= system[k, i] * right[k]
        right[i] /= system[i, i]
    return True


@compiled_inside
def multiply_out(m: Mechanism, jacobian: Floats, system: Floats) -> None:
    """Fill in J M⁻¹ Jᵀ, below its diagonal."""
    for i in range(len(m.row)):
        for j in range(i + 1):
            total = 0.0
            for k in range(len(m.inverse_mass)):
                total += jacobian[i, k] * m.inverse_mass[k] * jacobian[j, k]
            system[i, j] = total


@compiled_inside
def accelerate(
    m: Mechanism,
    t: float,
    y: Floats,
    closed: np.ndarray,
    impact: Floats,
    slope: Floats,
    told: Floats,
    multipliers: Floats,
) -> bool:
    """Fill in the rate of the state, what is told of contacts, and multipliers; whether it can."""
    half, rows = len(y) // 2, len(m.row)
    load = np.zeros(half)
    for b in range(half // 3):
        load[3 * b] = m.gravity[0] / m.inverse_mass[3 * b]
        load[3 * b + 1] = m.gravity[1] / m.inverse_mass[3 * b]
    for j in range(len(m.play)):
        touch(m, j, y, closed[j], impact[j], told[j])
        load_play(m, j, y, told[j], load)
    for s in range(len(m.spring)):
        _, _, tension, ux, uy = stretch(m, s, y)
        push(m, m.spring[s, 0], y, tension * ux, tension * uy, load)
        push(m, m.spring[s, 1], y, -tension * ux, -tension * uy, load)
    for s in range(len(m.motor)):
        moment, _ = turn(m, s, y)
        for end, sense in ((0, -1.0), (1, 1.0)):
            if m.body[m.motor[s, end]] >= 0:
                load[3 * m.body[m.motor[s, end]] + 2] += sense * moment
    jacobian, system = np.empty((rows, half)), np.empty((rows, rows))
    off, drift, gamma = np.empty(rows), np.empty(rows), np.empty(rows)
    constrain(m, t, y, jacobian, off, drift, gamma)
    multiply_out(m, jacobian, system)
    for r in range(rows):
        free = 0.0
        for k in range(half):
            free += jacobian[r, k] * m.inverse_mass[k] * load[k]
        multipliers[r] = gamma[r] - free
    regular = solve(system, multipliers)
    for k in range(half):
        total = load[k]
        for r in range(rows):
            total += jacobian[r, k] * multipliers[r]
        slope[k] = y[half + k]
        slope[half + k] = m.inverse_mass[k] * total
    return regular


@compiled_inside
def project(m: Mechanism, t: float, y: Floats) -> None:
    """Move the state onto its constraints, as little as possible in the norm of the masses."""
    half, rows = len(y) // 2, len(m.row)
    if rows == 0:
        return
    jacobian, system = np.empty((rows, half)), np.empty((rows, rows))
    off, drift, gamma = np.empty(rows), np.empty(rows), np.empty(rows)
    for level in range(2):
        constrain(m, t, y, jacobian, off, drift, gamma)
        multiply_out(m, jacobian, system)
        right = off if level == 0 else drift
        solve(system, right)
        for k in range(half):
            total = 0.0
            for r in range(rows):
                total += jacobian[r, k] * right[r]
            y[level * half + k] -= m.inverse_mass[k] * total
