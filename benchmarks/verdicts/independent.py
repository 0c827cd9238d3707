"""Two mechanisms integrated by other means: compiled Runge-Kutta 4 in small steps, exact flight.

Nothing here is the solver's. Both functions return sections once a period of the drive, and how the
distance of a neighbour grew in each, by Benettin's method.
"""

import math

import numpy as np
from numba import njit

from jointplay.records.arrays import Floats

Numbers = tuple[float, ...]
NEAR = 1e-8
"""Distance of the neighbour, rad or m, to which it is brought back every period."""
SWINGS = 600
"""Steps a period of the pendulum."""
LOOKS = 400
"""Instants a period at which the mass may be found behind the stop."""
IMPACT = 600
"""Steps an impact, more or less."""


@njit(cache=True)
def _pendulum_period(
    theta: float, omega: float, damping: float, weight: float, moment: float, speed: float
) -> tuple[float, float]:
    step = 2.0 * math.pi / speed / SWINGS
    for k in range(SWINGS):
        time = k * step
        drive = (
            moment * math.cos(speed * time),
            moment * math.cos(speed * (time + 0.5 * step)),
            moment * math.cos(speed * (time + step)),
        )
        a1 = drive[0] - damping * omega - weight * math.sin(theta)
        v2 = omega + 0.5 * step * a1
        a2 = drive[1] - damping * v2 - weight * math.sin(theta + 0.5 * step * omega)
        v3 = omega + 0.5 * step * a2
        a3 = drive[1] - damping * v3 - weight * math.sin(theta + 0.5 * step * v2)
        v4 = omega + step * a3
        a4 = drive[2] - damping * v4 - weight * math.sin(theta + step * v3)
        theta += step / 6.0 * (omega + 2.0 * v2 + 2.0 * v3 + v4)
        omega += step / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4)
    return theta, omega


@njit(cache=True)
def pendulum(theta: float, omega: float, numbers: Numbers, periods: int) -> tuple[Floats, Floats]:
    """Return (periods, 2) sections and (periods,) logarithms of a neighbour's growth.

    numbers : damping, weight, moment and angular velocity of the drive: theta'' = moment
    cos(speed t) - damping theta' - weight sin(theta).
    """
    damping, weight, moment, speed = numbers
    sections, growth = np.empty((periods, 2)), np.empty(periods)
    near, near_omega = theta + NEAR, omega
    for k in range(periods):
        theta, omega = _pendulum_period(theta, omega, damping, weight, moment, speed)
        near, near_omega = _pendulum_period(near, near_omega, damping, weight, moment, speed)
        apart, faster = near - theta, (near_omega - omega) / speed
        distance = max(math.hypot(apart, faster), 1e-300)
        growth[k] = math.log(distance / NEAR)
        near = theta + apart * NEAR / distance
        near_omega = omega + faster * NEAR / distance * speed
        sections[k] = theta, omega
    return sections, growth


@njit(cache=True)
def _flight(
    position: float, rate: float, time: float, span: float, numbers: Numbers
) -> tuple[float, float]:
    """Return position and rate a span later, without the stop: in closed form."""
    spring, damping, radius, speed, _gap, _stop, _loss = numbers
    half = 0.5 * damping
    own = math.sqrt(spring - half * half)
    response = spring * radius / complex(spring - speed * speed, damping * speed)
    turned = response * complex(math.cos(speed * time), math.sin(speed * time))
    later = time + span
    turned_later = response * complex(math.cos(speed * later), math.sin(speed * later))
    u, y = position - turned.real, rate - (1j * speed * turned).real
    fade, cosine, sine = math.exp(-half * span), math.cos(own * span), math.sin(own * span)
    moved = fade * (u * (cosine + half / own * sine) + y * sine / own)
    faster = fade * (y * cosine - (half * y + spring * u) / own * sine)
    return moved + turned_later.real, faster + (1j * speed * turned_later).real


@njit(cache=True)
def _pushed(position: float, rate: float, time: float, struck: float, numbers: Numbers) -> float:
    """Return the acceleration at the stop, whose force never pulls."""
    spring, damping, radius, speed, gap, stop, loss = numbers
    depth = max(position - gap, 0.0)
    force = max(stop * depth * math.sqrt(depth) * (1.0 + loss * rate / struck), 0.0)
    return spring * (radius * math.cos(speed * time) - position) - damping * rate - force


@njit(cache=True)
def _impact(
    position: float, rate: float, time: float, numbers: Numbers
) -> tuple[float, float, float]:
    """Return position, rate and time when the mass has left the stop that it meets at a rate."""
    struck, stop = rate, numbers[5]
    step = 3.2 * (1.0 / (stop * stop * struck)) ** 0.2 / IMPACT
    for _ in range(1000 * IMPACT):
        a1 = _pushed(position, rate, time, struck, numbers)
        v2 = rate + 0.5 * step * a1
        a2 = _pushed(position + 0.5 * step * rate, v2, time + 0.5 * step, struck, numbers)
        v3 = rate + 0.5 * step * a2
        a3 = _pushed(position + 0.5 * step * v2, v3, time + 0.5 * step, struck, numbers)
        v4 = rate + step * a3
        a4 = _pushed(position + step * v3, v4, time + step, struck, numbers)
        position += step / 6.0 * (rate + 2.0 * v2 + 2.0 * v3 + v4)
        rate += step / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4)
        time += step
        if position <= numbers[4]:
            break
    return position, rate, time


@njit(cache=True)
def _oscillator_period(position: float, rate: float, numbers: Numbers) -> tuple[float, float]:
    speed, gap = numbers[3], numbers[4]
    period = 2.0 * math.pi / speed
    step, time = period / LOOKS, 0.0
    while time < period - 1e-12:
        span = min(step, period - time)
        moved, faster = _flight(position, rate, time, span, numbers)
        leaves = position > gap and rate < 0.0  # an impact that lasted beyond the last section
        if moved <= gap or leaves:
            position, rate, time = moved, faster, time + span
            continue
        low, high = 0.0, span
        for _ in range(60):
            middle = 0.5 * (low + high)
            if _flight(position, rate, time, middle, numbers)[0] > gap:
                high = middle
            else:
                low = middle
        met, struck = _flight(position, rate, time, high, numbers)
        position, rate, time = _impact(max(met, gap), max(struck, 1e-12), time + high, numbers)
        position = min(position, gap)
    if time > period:  # an impact that lasts beyond the section
        position, rate = _flight(position, rate, time, period - time, numbers)
    return position, rate


@njit(cache=True)
def oscillator(
    position: float, rate: float, numbers: Numbers, periods: int
) -> tuple[Floats, Floats]:
    """Return (periods, 2) sections and (periods,) logarithms of a neighbour's growth.

    numbers : spring, damping, radius and speed of the crank, gap, stop (N/m^1.5) and the factor of
    its damping, for a mass of 1 kg.
    """
    speed = numbers[3]
    sections, growth = np.empty((periods, 2)), np.empty(periods)
    near, near_rate = position - NEAR, rate
    for k in range(periods):
        position, rate = _oscillator_period(position, rate, numbers)
        near, near_rate = _oscillator_period(near, near_rate, numbers)
        apart, faster = near - position, (near_rate - rate) / speed
        distance = max(math.hypot(apart, faster), 1e-300)
        growth[k] = math.log(distance / NEAR)
        near = position + apart * NEAR / distance
        near_rate = rate + faster * NEAR / distance * speed
        sections[k] = position, rate
    return sections, growth
