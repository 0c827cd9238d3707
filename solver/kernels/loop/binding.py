"""Sets a lane's numbers: those of its scene, its error scales, its clock and its counters."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from jointplay.solver.kernels.layout import LANES
from jointplay.solver.kernels.loop.periods import PACE_STEPS, set_clock
from jointplay.solver.kernels.loop.problem import Event, LaneProblem
from jointplay.solver.kernels.loop.start import mechanism_size, start_state
from jointplay.solver.kernels.loop.state import Counter, SectionKind, Setting
from jointplay.solver.mechanics.assembly import assemble, shortest_link
from jointplay.solver.scene.document import Revolute, Scene
from jointplay.solver.scene.periods import characteristic_time, common_period
from jointplay.solver.scene.references import clearances

if TYPE_CHECKING:
    from jointplay.solver.kernels.loop.bundle import Bundle

STEPS_IN_A_PERIOD = 100
"""Fewest steps a period: the step grows no longer than that, so that no passing event is missed."""
RESTART = 1e-3
"""The first step in contact closes this share of the clearance at the impact rate."""
SMALLEST_STEP = 1e-15
"""Of a period: a step below it ends the run."""
ACROSS = 6.0
"""Speeds are measured against at most this multiple of that which a journal has after falling
through the smallest clearance: else impacts in a small one would be lost in the tolerance."""
RESOLVED = 1.0
"""Of the slip velocity at which friction is full: the error of a speed in a step stays below."""
STRICTEST = 1e-14
"""While nothing has moved as fast as the scene's scale of speed, the tolerance is smaller by as
much, down to this: else what a run does that is nearly at rest would be lost in the tolerance."""
FIRST_STEP = 1e-6
"""First step, in periods."""


def bind(bundle: Bundle, lane: int, problem: LaneProblem, like: int | None = None) -> None:
    """Set a lane's numbers, scales and start; `like` is a lane that has the scene's numbers."""
    kernel, scene, work = bundle.kernel, problem.scene, bundle.work.reshape(-1, LANES)
    if like is None:
        _number(bundle, lane, scene)
    else:
        work[:, lane] = work[:, like]
    length = shortest_link(scene)
    unit = characteristic_time(scene, length)
    common = common_period(scene).seconds
    _clock(bundle, lane, problem, common or unit, common is not None)
    _scale(bundle, lane, problem, length, unit)
    if problem.start is None:
        assembly = assemble(scene)
        start = start_state(scene, kernel.coordinates, assembly.pose, assembly.velocity)
        state = np.concatenate(start)
    else:
        state = problem.start.state
    bundle.table("y0", kernel.states)[:, lane] = state
    speeds = slice(kernel.states // 2, None)
    shares = np.abs(state[speeds]) * bundle.table("weight0", kernel.states)[speeds, lane]
    full = 1.0 / problem.tolerance
    bundle.table("full")[0, lane] = full
    bundle.table("fastest")[0, lane] = min(max(STRICTEST * full**2, *shares), full)


def _number(bundle: Bundle, lane: int, scene: Scene) -> None:
    """Evaluate what depends on the scene's numbers alone."""
    kernel, work = bundle.kernel, bundle.work.reshape(-1, LANES)
    for (slot, _), value in zip(kernel.fixed, kernel.fixed_values(scene), strict=True):
        work[slot, lane] = value
    if bundle.tangents is not None:
        values = bundle.tangents.fixed_values(scene)
        for (slot, _), value in zip(bundle.tangents.fixed, values, strict=True):
            work[slot, lane] = value


def _scale(bundle: Bundle, lane: int, problem: LaneProblem, length: float, unit: float) -> None:
    """Set what a lane's errors and first steps in contact are measured by."""
    kernel, scene = bundle.kernel, problem.scene
    count = len(kernel.coordinates)
    fits = list(clearances(scene).values())
    finest = min((fit.radial_clearance for fit in fits), default=math.inf)
    reach = mechanism_size(scene, length)
    radian = unit / (2.0 * math.pi)
    acceleration = math.hypot(*scene.gravity) + length / radian**2
    crossing = ACROSS * math.sqrt(acceleration * finest) / length
    laws = [fit.friction for fit in fits if fit.friction is not None and not fit.friction.is_off]
    steepest = RESOLVED * min((law.full_slip_speed for law in laws), default=math.inf)
    for i, name in enumerate(kernel.coordinates):
        angle = name.endswith(".theta")
        scale = 1.0 if angle else length
        close = min(scale, finest / reach if angle else finest)
        bundle.table(f"weight{i}")[0, lane] = 1.0 / (problem.tolerance * close)
        slow = scale * min(1.0 / radian, crossing)
        slow = min(slow, steepest / problem.tolerance / (reach if angle else 1.0))
        bundle.table(f"weight{count + i}")[0, lane] = 1.0 / (problem.tolerance * slow)
    for j, fit in enumerate(fits):
        bundle.table(f"impact_floor{j}")[0, lane] = fit.contact.least_impact_rate
        restart = RESTART * fit.radial_clearance if problem.step is None else math.inf
        bundle.table(f"restart{j}")[0, lane] = restart


def _clock(bundle: Bundle, lane: int, problem: LaneProblem, period: float, common: bool) -> None:
    """Set a lane's time, counters and what falls due when."""
    scene = problem.scene
    since = 0.0 if problem.start is None else problem.start.time
    for name in ("memory", "steps", "tried", "before_step"):
        bundle.table(name)[0, lane] = 0.0
    for name in ("time", "stage_time", "before_time"):
        bundle.table(name)[0, lane] = since
    bundle.table("pace_at")[0, lane] = PACE_STEPS
    bundle.table("step")[0, lane] = problem.step or FIRST_STEP * period
    bundle.table("largest_step")[0, lane] = problem.step or period / STEPS_IN_A_PERIOD
    bundle.table("smallest_step")[0, lane] = period
    setting = bundle.settings[:, lane]
    setting[Setting.PERIOD] = period
    setting[Setting.COMMON] = 1.0 if common else 0.0
    turning = all(isinstance(scene.joints[d.joint], Revolute) for d in scene.drivers.values())
    setting[Setting.TURNING] = 1.0 if turning else 0.0
    setting[Setting.DURATION] = problem.duration
    setting[Setting.OUTPUT_STEP] = problem.output_step
    setting[Setting.SECTION_OFFSET] = problem.section_offset
    setting[Setting.SMALLEST_STEP] = SMALLEST_STEP * period
    for k, driver in enumerate(scene.drivers.values()):
        travel = driver.speed * period / (2.0 * math.pi if turning else 1.0)
        setting[Setting.FIRST_DRIVER + 2 * k] = driver.position
        setting[Setting.FIRST_DRIVER + 2 * k + 1] = round(travel) if common else travel
    event = problem.event or Event(SectionKind.CRANK, 0)
    setting[Setting.SECTION_KIND], setting[Setting.SECTION_PLACE] = event.kind, event.place
    setting[Setting.SECTION_VALUE], setting[Setting.SECTION_SENSE] = event.value, event.sense
    setting[Setting.SECTION_FROM] = event.not_before
    counter = bundle.counters[:, lane]
    counter[:] = 0
    counter[Counter.PERIOD] = 0 if problem.start is None else problem.start.period
    setting[Setting.PACE_TIME] = counter[Counter.PERIOD] * period + since
    counter[Counter.LANDING] = -1
    counter[Counter.SAMPLES], counter[Counter.SECTIONS] = problem.samples, problem.sections
    counter[Counter.SECTION] = problem.first_section
    counter[Counter.SAMPLE] = problem.first_sample
    set_clock(lane, bundle.slots, bundle.work, bundle.settings, bundle.counters)
