"""Largest exponents of maps and flows given as plain functions, and agreement of estimates."""

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from jointplay.solver.nonlinear.estimate import SIGNIFICANT, Estimate
from jointplay.solver.nonlinear.lyapunov import exponent_from_growth
from tests.solver.nonlinear.flow import Flow

Floats = NDArray[np.float64]


def agrees(found: Estimate, expected: float, errors: float = SIGNIFICANT) -> bool:
    """Return whether a value lies within a number of its errors of what is expected."""
    return abs(found.value - expected) <= errors * found.error


def map_exponent(
    step: Callable[[Floats], Floats],
    jacobian: Callable[[Floats], Floats],
    start: Floats,
    iterations: int,
    seed: int = 0,
) -> Estimate:
    """Return the largest exponent, per iteration, of a map x → `step`(x) with its `jacobian`.

    start : (d,); jacobian(x) : (d, d). The tangent vector starts in a random direction.
    """
    x, tangent = np.array(start, np.float64), _direction(len(start), seed)
    growth = np.empty(iterations)
    for i in range(iterations):
        tangent = jacobian(x) @ tangent
        x = step(x)
        growth[i], tangent = _normalised(tangent)
    return exponent_from_growth(growth, 1.0)


def tangent_exponent(
    flow: Flow, start: Floats, block_time: float, blocks: int, steps: int, seed: int = 0
) -> Estimate:
    """Return the largest exponent of a flow, with its events, from a tangent vector.

    start : (d,) at time 0; each block of `block_time` takes `steps` steps. At an event the vector
    is multiplied by the saltation matrix.
    """
    x, tangent = np.array(start, np.float64), _direction(len(start), seed)[:, None]
    growth = np.empty(blocks)
    for i in range(blocks):
        x, tangent = flow.advance_tangents(i * block_time, x, tangent, block_time, steps)
        growth[i], tangent = _normalised(tangent)
    return exponent_from_growth(growth, block_time)


def companion_exponent(
    advance: Callable[[float, Floats], Floats],
    start: Floats,
    block_time: float,
    blocks: int,
    *,
    distance: float = 1e-8,
    metric: Floats | None = None,
    seed: int = 0,
) -> Estimate:
    """Return the largest exponent from a companion that is kept at a small distance.

    advance : maps a time and the states (2, d), the motion's and its companion's, to those a block
        later. Both must take the same sequence of steps, each locating its own events: steps of
        their own would show how discretisation errors grow, not how the motions part.
    start : (d,) at time 0.
    distance : between the two after each block, in units of `metric`; small against the motion,
        large against its rounding.
    metric : (d,) what counts as one in each coordinate; default ones. The exponent does not depend
        on it, what distance is small does.

    Where exactly one of the two has passed an event at the end of a block the difference is that
    of the jump; with hard impacts this happens in about one of 1/`distance` blocks.
    """
    weights = np.ones(len(start)) if metric is None else np.asarray(metric, np.float64)
    x = np.array(start, np.float64)
    offset = distance * _direction(len(start), seed)
    growth = np.empty(blocks)
    for i in range(blocks):
        taken = (x + offset * weights - x) / weights  # what rounding leaves of the offset
        x, companion = advance(i * block_time, np.stack([x, x + offset * weights]))
        log_length, direction = _normalised((companion - x) / weights)
        growth[i] = log_length - 0.5 * math.log(float((taken**2).sum()))
        offset = distance * direction
    return exponent_from_growth(growth, block_time)


def _direction(dimension: int, seed: int) -> Floats:
    vector = np.random.default_rng(seed).standard_normal(dimension)
    return np.asarray(vector / np.sqrt((vector**2).sum()), np.float64)


def _normalised(vector: Floats) -> tuple[float, Floats]:
    """Return the logarithm of a vector's length, and the vector with length one."""
    length = float(np.sqrt((vector**2).sum()))
    if length == 0.0:
        return -math.inf, vector
    return math.log(length), vector / length
