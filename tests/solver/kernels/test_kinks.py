"""Kinks inside steps: when a step passes one, and what slope a tangent takes then."""

import math

import numpy as np
import pytest

from jointplay.solver.kernels.emit import kinks
from jointplay.solver.kernels.emit.emit import FixedNodes, lane_function
from jointplay.solver.kernels.emit.module import load
from jointplay.solver.kernels.layout import Layout
from jointplay.solver.kernels.target import own_target
from jointplay.solver.kernels.trace.derivative import Derivative
from jointplay.solver.kernels.trace.tracer import Tracer
from jointplay.solver.laws.friction.modified_coulomb import ModifiedCoulomb

LANES = own_target().lanes


def slopes_over_steps(
    static: float,
    dynamic: float,
    steps: list[tuple[float, float]],
    rates: list[tuple[float, float]] | None = None,
    lengths: list[float] | None = None,
) -> list[float]:
    """Return the slope of friction that a tangent takes at the end of each step, a step a lane.

    The normal force and the coefficient are 1; a step is its slip velocities at both ends, m/s.
    rates : of the slip at both ends, m/s^2; it is constant if not given. lengths : of steps, s.
    """
    rates = rates or [(last - first,) * 2 for first, last in steps]
    lengths = lengths or [1.0] * len(steps)
    tracer = Tracer()
    slip, along = tracer.variable("slip"), tracer.variable("along")
    law = ModifiedCoulomb(coefficient=1.0, static_velocity=static, dynamic_velocity=dynamic)
    force = law.friction_force(tracer.variable("normal_force"), slip)
    bends = tuple(tracer.kinks.items())
    derivative = Derivative({"slip": along})
    kinks.take_mean_slopes(derivative, bends)
    layout = Layout()
    layout.add("slip", "along", "normal_force", "slope", "rate", "tried")
    kinks.allocate(layout, len(bends))
    fixed = FixedNodes(layout)
    sources = [
        kinks.kink_function(bends, Derivative({"slip": tracer.variable("rate")}), layout, fixed),
        lane_function("follow", [("slope", derivative(force))], layout, fixed),
    ]
    module = load(sources, LANES)
    found: list[float] = []
    for first in range(0, len(steps), LANES):
        some = steps[first : first + LANES]
        work = np.zeros((layout.size, LANES))
        work[layout["along"]] = work[layout["normal_force"]] = 1.0
        here = slice(first, first + len(some))
        work[layout["tried"], : len(some)] = lengths[here]
        for end in range(2):
            work[layout["slip"], : len(some)] = [step[end] for step in some]
            work[layout["rate"], : len(some)] = [pair[end] for pair in rates[here]]
            module.kinks(work)
            if end == 0:
                work[layout.block("kink_start")] = work[layout.block("kink_end")]
        module.follow(work)
        found += work[layout["slope"], : len(some)].tolist()
    return found


def test_a_step_that_passes_no_kink_has_the_slope_where_it_is() -> None:
    steps = [(0.15, 0.25), (-0.2, -0.12), (0.5, 0.9), (-0.9, -0.4), (0.05, 0.02)]
    assert slopes_over_steps(0.1, 0.3, steps) == pytest.approx([-5.0, -5.0, 0.0, 0.0, 0.0])


def test_a_step_that_passes_kinks_has_the_mean_slope() -> None:
    steps = [(0.2, 0.4), (0.4, 0.2), (0.05, 0.2), (-0.5, 0.5), (-0.05, 0.05), (0.2, -0.2)]
    means = [-0.5 / 0.2, -0.5 / 0.2, -0.5 / 0.15, -2.0 / 1.0, 0.0, -1.0 / 0.4]
    assert slopes_over_steps(0.1, 0.3, steps) == pytest.approx(means)


def test_a_slip_that_friction_alone_slows_has_the_mean_slope_over_time() -> None:
    # slips s of a unit mass under a force A less friction, s' = A - c(s), c = 5 (|s| - 0.1) in the
    # ramp: the integral of c' over time is that of dc over A - c, a logarithm
    ends_in_the_ramp = 0.1 + 0.2 * math.log(2.0)  # A = 0: from s' = -1 to -0.5
    leaves_the_ramp = 0.2 * math.log(2.0) + 0.1 / 0.5  # A = 1.5: from 1 to 0.5, before it is out
    turns_round = 0.2 / 3.0 + 0.2 * math.log(1.5) + 0.2 / 2.0 + 0.2 * math.log(2.0) + 0.2
    steps = [(0.4, 0.2), (0.2, 0.4), (0.5, -0.5), (0.4, 0.2)]
    rates = [(-1.0, -0.5), (1.0, 0.5), (-3.0, -1.0), (-1.0, -0.9995)]
    lengths = [ends_in_the_ramp, leaves_the_ramp, turns_round, 0.2]
    logarithms = [math.log(2.0), math.log(2.0), math.log(3.0), 0.5 * math.log(1 / 0.9995) / 0.0005]
    means = [-each / length for each, length in zip(logarithms, lengths, strict=True)]
    assert slopes_over_steps(0.1, 0.3, steps, rates, lengths) == pytest.approx(means, rel=1e-9)


def test_a_slip_that_another_force_drives_or_turns_has_the_slope_of_the_chord() -> None:
    steps, rates = [(0.4, 0.2)] * 2, [(-0.5, -1.0), (-1.0, 0.5)]
    assert slopes_over_steps(0.1, 0.3, steps, rates) == pytest.approx([-2.5, -2.5])


def test_a_slip_that_goes_on_through_a_jump_of_friction_has_the_slope_of_the_chord() -> None:
    steps = [(0.05, 0.15), (0.15, -0.15), (0.15, 0.2), (-0.05, 0.05)]
    assert slopes_over_steps(0.1, 0.1, steps) == pytest.approx([-1.0 / 0.1, -2.0 / 0.3, 0.0, 0.0])


def test_a_step_on_which_nothing_slips_divides_by_nothing() -> None:
    assert slopes_over_steps(0.1, 0.3, [(0.0, 0.0), (0.2, 0.2), (0.5, 0.5)]) == pytest.approx(
        [0.0, -5.0, 0.0]
    )
