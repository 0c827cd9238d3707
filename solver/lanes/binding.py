"""Sets numbers of a lane: those of its scene, its error scales, its clock and its counters.

Or of many lanes of one structure at once, whose scene has `Varied` numbers and whose problem has
(lanes,) where they differ: the same arithmetic, so the same bits.
"""

import math

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.kernels.emit.enclosure import HELD, SKIN
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.emit.slots import KEEPS_LEDGER
from jointplay.solver.kernels.emit.tangents import Tangents
from jointplay.solver.kernels.layout import BENDS
from jointplay.solver.kernels.loop.runs import (
    NO_PAIR,
    PACE_STEPS,
    SAMPLES,
    SECTIONS,
    SectionKind,
)
from jointplay.solver.lanes.lane import Lane
from jointplay.solver.lanes.problem import Event, LaneProblem
from jointplay.solver.mechanics.assembly import assemble, shortest_link, start_of
from jointplay.solver.mechanics.impact_floors import impact_floor
from jointplay.solver.mechanics.start.states import mechanism_size, start_state
from jointplay.solver.quantities.scalars import greatest, least, minimum, sqrt
from jointplay.solver.scene.clocks import clocks
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.pairs import contact_pairs
from jointplay.solver.scene.periods import common_period
from jointplay.solver.scene.references import inner_states
from jointplay.solver.scene.time_scales import characteristic_time, driven_speed, driven_travel

STEPS_IN_A_PERIOD = 100
"""Fewest steps in a period of the fastest driver, or in the scene's own scale of time."""
ROWS = {"slip_velocity": "slip_row", "penetration": "penetration_row", "normal_force": "normal_row"}
"""Slots that have the rows of a pair's channels."""
RESTART = 1e-3
"""The first step in contact closes this share of the clearance at the impact rate."""
SMALLEST_STEP = 1e-15
"""Share of a period: a step below it ends the run."""
ACROSS = 6.0
"""Speeds are measured against at most this multiple of that which a journal has after falling
through the smallest clearance: else impacts in a small one would be lost in the tolerance."""
RESOLVED = 1.0
"""Share of the slip velocity at which friction is full that bounds a speed's error in a step."""
STRICTEST = 1e-14
"""While nothing has moved as fast as the scene's scale of speed, the tolerance is smaller by as
much, down to this: else what a run does that is nearly at rest would be lost in the tolerance."""
FROM_ZERO = (
    *("memory", "steps", "tried", "before_step"),
    *("look_at", "look_beyond", "looked_into", "swing", "rough_until"),
)
"""Slots that are zero where a run begins."""
FIRST_STEP = 1e-6
"""First step, in such periods."""


def bind(lane: Lane, problem: LaneProblem, like: Floats | None = None) -> None:
    """Set numbers, scales and starts, but no clocks; `like` : (slots,) that have the numbers."""
    kernel, scene = lane.kernel, problem.scene
    if like is not None:
        lane.column.T[:] = like
    else:
        lane["alike"].T[:], lane["bent"].T[:] = kernel.rows.alike, kernel.rows.bent
        number(lane, kernel, scene)
        if lane.tangents is not None:
            number(lane, lane.tangents, scene)
    length = shortest_link(scene)
    unit = characteristic_time(scene, length)
    period = common_period(scene)
    common = period.seconds is not None and not period.given
    _clock(lane, problem, period.seconds or unit, common)
    _limit(lane, problem, length, unit)
    _scale(lane, problem, length, unit)
    state = own_start(kernel, scene) if problem.start is None else problem.start.state
    lane["y"].T[:] = state.T  # (states,) of all lanes, or (states, lanes)
    count = len(kernel.coordinates)
    shares = np.abs(lane["y"][count : 2 * count]) * lane["weight"][count : 2 * count]
    full = 1.0 / problem.tolerance
    lane["full"] = full
    fastest = np.maximum(np.max(shares, axis=0, initial=0.0), STRICTEST * full * full)
    lane["fastest"] = np.minimum(fastest, full)


def own_start(kernel: Kernel, scene: Scene, one: Scene | None = None) -> Floats:
    """Return the states of a scene's own start, (states,).

    (states, points) if the drivers' speeds are those of many points, of which `one` is the scene of
    one.
    """
    if one is not None:
        return start_state(scene, kernel.coordinates, *start_of(scene, one))
    assembly = assemble(scene)
    return start_state(scene, kernel.coordinates, assembly.pose, assembly.velocity)


def number(lane: Lane, compiled: Kernel | Tangents, scene: Scene) -> None:
    """Evaluate what compiled functions need that depends on the scene's numbers alone."""
    for slot, value in zip(compiled.fixed.slots, compiled.fixed.values(scene), strict=True):
        lane.work[slot, lane.index] = value


def _scale(lane: Lane, problem: LaneProblem, length: float, unit: float) -> None:
    """Set what a lane's errors and first steps in contact are measured by."""
    kernel, scene = lane.kernel, problem.scene
    count = len(kernel.coordinates)
    pairs = contact_pairs(scene).values()
    finest = least(pair.play for pair in pairs)
    reach = mechanism_size(scene, length)
    radian = unit / (2.0 * math.pi)
    gravity = sqrt(sum(part * part for part in scene.gravity))
    acceleration = gravity + length / (radian * radian)
    crossing = ACROSS * sqrt(acceleration * finest) / length
    laws = [pair.clearance.friction for pair in pairs]
    full = [law.full_slip_speed for law in laws if law is not None and not law.is_off]
    steepest = RESOLVED * least(full)
    for i, name in enumerate(kernel.coordinates):
        angle = name.endswith(".theta")
        scale = 1.0 if angle else length
        close = minimum(scale, finest / reach if angle else finest)
        lane["weight"][i] = 1.0 / (problem.tolerance * close)
        slow = scale * minimum(1.0 / radian, crossing)
        slow = minimum(slow, steepest / problem.tolerance / (reach if angle else 1.0))
        lane["weight"][count + i] = 1.0 / (problem.tolerance * slow)
    inner = (state for states in inner_states(scene).values() for state in states)
    for i, state in enumerate(inner, start=2 * count):
        lane["weight"][i] = 1.0 / (problem.tolerance * state.scale)
    for j, pair in enumerate(pairs):
        lane["impact_floor"][j] = impact_floor(scene, pair, length)
        lane["abrupt"][j] = pair.clearance.contact.jumps_at_onset
        lane["restart"][j] = RESTART * pair.play if problem.step is None else math.inf


def _limit(lane: Lane, problem: LaneProblem, length: float, unit: float) -> None:
    """Set what limits a lane's steps: the fastest driver's period, and what encloses journals.

    The period that all drivers have in common may be a thousand times as long.
    """
    scene = problem.scene
    lane.run["unit"] = unit
    lane["step"] = problem.step or FIRST_STEP * unit
    lane["largest_step"] = problem.step or unit / STEPS_IN_A_PERIOD
    sliders = [pair.size for pair in contact_pairs(scene).values() if not pair.is_journal]
    travel = driven_travel(scene, unit, problem.duration)  # farther, maybe, than bodies are long
    lever = greatest([mechanism_size(scene, length), travel, *sliders])
    lane["lever"] = lever
    lane["bend"] = math.inf
    lane["driven_speed"] = driven_speed(scene, lever, problem.duration)
    for j, (name, pair) in enumerate(contact_pairs(scene).items()):
        lane["inner"][j] = (1.0 - SKIN) * pair.play
        lane["outer"][j] = (1.0 + HELD * problem.tolerance) * pair.play
        law = pair.clearance.friction
        if law is not None and not law.is_off:
            for k, bend in enumerate(law.bends, start=BENDS * j):
                lane["bend"][k] = bend
        for quantity, slot in ROWS.items():
            lane[slot][j] = lane.kernel.rows.watched_row(f"{name}.{quantity}")
    inner = [f"{pair}.{one.name}" for pair, own in inner_states(scene).items() for one in own]
    for k, name in enumerate(inner):
        lane["inner_row"][k] = lane.kernel.rows.watched_row(name)


def _clock(lane: Lane, problem: LaneProblem, period: float, common: bool) -> None:
    """Set a lane's time, its run, and what falls due when."""
    scene = problem.scene
    since = 0.0 if problem.start is None else problem.start.time
    for name in FROM_ZERO:
        lane[name] = 0.0
    for name in ("time", "stage_time", "before_time"):
        lane[name] = since
    lane["pace_at"] = PACE_STEPS
    lane[KEEPS_LEDGER] = float(problem.ledger)
    lane["smallest_step"] = period
    for k, clock in enumerate(clocks(scene).values()):
        travel = clock.rate * period / (clock.turn or 1.0)
        lane["clock_start"][k], lane["clock_turn"][k] = clock.start, clock.turn
        lane["clock_travel"][k] = round(travel) if common and clock.turn else travel
    event = problem.event or Event(SectionKind.CRANK, 0)
    periods = 0 if problem.start is None else problem.start.period
    run = lane.run
    run["landing"] = NO_PAIR
    run["period"], run["common"] = period, common
    run["periods"], run["pace_time"] = periods, periods * period + since
    run["duration"], run["output_step"] = problem.duration, problem.output_step
    run["smallest_step"] = SMALLEST_STEP * period
    run["next"][..., SAMPLES], run["stop"][..., SAMPLES] = problem.first_sample, problem.samples
    run["next"][..., SECTIONS], run["stop"][..., SECTIONS] = problem.first_section, problem.sections
    run["section_kind"], run["section_index"] = event.kind, event.index
    run["section_value"], run["section_sense"] = event.value, event.sense
    run["section_turn"], run["tangent_forgets"] = event.turn, problem.tangent_forgets
    run["section_from"], run["section_offset"] = event.not_before, problem.section_offset
