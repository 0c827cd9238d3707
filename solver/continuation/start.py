"""Starts of branches: the orbit next to a section that the motion has come to."""

from dataclasses import replace

import numpy as np

from jointplay.solver.continuation.multipliers import largest, size
from jointplay.solver.continuation.orbit import Curve, NoOrbit, Orbit, Scales
from jointplay.solver.continuation.passage import Passage, Section
from jointplay.solver.continuation.section_map import DIFFERENCE, TURN, SectionMap
from jointplay.solver.continuation.settled import NoStart, Settled
from jointplay.solver.mechanics.assembly import shortest_link
from jointplay.solver.mechanics.start.states import mechanism_size
from jointplay.solver.runs.starts import start_scales

LEAST_EXTENT = 1e-3
"""Least extent of a state that hardly moves, in what counts as one in it."""
AT_REST = DIFFERENCE
"""The same up to which a state does not move: where it begins to, by how much is not known."""
SAME = 1e-6
"""Distance, in the scales of the states, within which an orbit has come back."""
WOUND = 1e-4
"""The same some turns on: the orbit's angles may have been large before."""


def scaled(map_: SectionMap, value: float, settled: Settled) -> Curve:
    """Return the curve of orbits in the scales of a motion.

    Differences are shares of what counts as one in each state, or of its extent if that is less;
    lengths along the branch are in extents, so that a state that moves far does not rule them. That
    of a state at rest is one: it says nothing of motions that begin in it.
    Impact rates are measured in the fastest motion, m/s: of what turns at the mechanism's size.
    """
    scene, kernel = map_.scene_at(value), map_.kernel
    if map_.crossing is not None:
        map_ = replace(map_, crossing=replace(map_.crossing, interval=settled.interval))
    one = start_scales(scene, kernel.coordinates, map_.interval(scene), scene.length)
    pairs = len(kernel.pairs)
    moves = settled.extents > AT_REST * one
    extents = np.where(moves, np.maximum(settled.extents, LEAST_EXTENT * one), one)
    count = len(kernel.coordinates)
    reach = mechanism_size(scene, shortest_link(scene))
    arms = np.array([reach if name.endswith(".theta") else 1.0 for name in kernel.coordinates])
    rates = np.full(pairs, (arms * extents[count : 2 * count]).max(initial=0.0) or 1.0)
    scales = np.concatenate([np.minimum(one, extents), rates])
    weight = np.concatenate([np.full(kernel.states, 1.0 / kernel.states), np.zeros(pairs), [1.0]])
    whole = np.concatenate([extents, rates, [map_.width]])
    map_ = replace(map_, scales=scales, steps=settled.steps, back_after=settled.back_after)
    return Curve(map_, Scales(whole, weight))


def first_orbit(curve: Curve, section: Section) -> Orbit:
    """Return the periodic orbit next to a section, at its value of the parameter.

    Raises
    ------
    NoStart
        There is none near, it repeats after fewer periods, or nothing tells it from others.
    """
    axis = np.zeros(curve.map.size + 1)
    axis[-1] = 1.0
    found = curve.orbit(curve.vector(section), axis)
    if isinstance(found, NoOrbit):
        raise NoStart(
            f"There is no orbit of period {curve.map.periods} near the section that was reached:"
            f" {found.reason}. Try another 'period', more periods to 'settle', more 'orbits' where"
            " the motion is chaotic, or a 'state' next to the orbit."
        )
    shorter = shorter_period(found)
    if shorter:
        raise NoStart(
            f"The orbit that was found repeats after {shorter} of the {curve.map.periods} periods;"
            f" ask for 'period' {shorter}."
        )
    return within_a_turn(repeated(isolated(found)))


def repeated(orbit: Orbit) -> Orbit:
    """Return an orbit of a driven mechanism that comes back another time, as the clock goes on.

    NoStart: it does not, where a force depends on how often a driver has turned.
    """
    map_, section = orbit.curve.sections, orbit.section
    (again,) = replace(map_, periods=2 * map_.periods).passages([section])
    lost = WOUND * max(1.0, largest(orbit.multipliers))
    if map_.crossing is None and not again.failure and _apart(map_, again, section) > lost:
        raise NoStart(
            "The motion comes back after the first period of the drive and not after the next: a"
            " force depends on how often a driver has turned. Give that a course that repeats."
        )
    return orbit


def isolated(orbit: Orbit) -> Orbit:
    """Return an orbit that has no neighbours at its value of the parameter.

    NoStart: it has, where nothing drives the mechanism.
    """
    nearest = min(size(one - 1.0) for one in orbit.multipliers.tolist())
    if orbit.curve.sections.crossing is not None and nearest <= orbit.slack:
        raise NoStart(
            "A multiplier of the orbit that was found is 1: it is one of a family at the same value"
            " of the parameter, such as one for each energy where nothing takes that away. Let"
            " something damp the mechanism, and something drive it."
        )
    return orbit


def shorter_period(orbit: Orbit) -> int:
    """Return after how many periods an orbit is back already, fewer than its own; 0: it is not."""
    map_, section = orbit.curve.sections, orbit.section
    for periods in range(1, map_.periods):
        if map_.periods % periods:
            continue
        (passage,) = replace(map_, periods=periods).passages([section])
        if _apart(map_, passage, section) < SAME:
            return periods
    return 0


def within_a_turn(orbit: Orbit) -> Orbit:
    """Return an orbit that begins as many returns earlier as one that goes round has made.

    Its angles round off less. NoStart: it is none from there.
    """
    curve, map_, section = orbit.curve, orbit.curve.sections, orbit.section
    passage = orbit.linear.passage
    turned = passage.end - section.state - map_.away(passage.end, section.state)
    turned[list(map_.cyclic)] = 0.0
    if not turned.any():
        return orbit
    turns, fastest = np.round(turned / TURN), np.abs(turned).argmax()
    returns = np.round(section.state[fastest] / turned[fastest])
    moved = replace(section, state=section.state - TURN * ((returns or -1.0) * turns))
    (again,) = map_.passages([moved])
    if again.failure or _apart(map_, again, moved) > WOUND:
        raise NoStart(
            "The motion goes round, and is another one some turns later: something in the mechanism"
            " winds up. Try a 'state' next to an orbit that comes back."
        )
    return first_orbit(curve, moved) if returns else orbit


def _apart(map_: SectionMap, passage: Passage, section: Section) -> float:
    """Return how far a run ends from its start, in the scales of the states."""
    away = map_.away(passage.end, section.state)
    return float(np.abs(away / map_.scales)[: map_.kernel.states].max())
