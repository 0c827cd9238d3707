"""Lanes made ready to run, many at once: a lane by itself takes Python a hundred times as long."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Flags, Floats, Integers
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.emit.tangents import Tangents
from jointplay.solver.kernels.loop.entry_points import set_clocks
from jointplay.solver.kernels.loop.runs import DTYPE, Status
from jointplay.solver.lanes.beginning import begin, resting_rates
from jointplay.solver.lanes.binding import bind, own_start
from jointplay.solver.lanes.lane import Lane, aligned_zeros
from jointplay.solver.lanes.problem import LaneProblem, LaneStart
from jointplay.solver.quantities.varied import REFUSALS, together
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.references import tangent_obstacle

ENERGIES = ("energy.kinetic", "energy.potential", "stored")
DIFFERING = (
    "tolerance",
    "step",
    "duration",
    "output_step",
    "samples",
    "sections",
    "section_offset",
    "first_section",
    "first_sample",
)
"""Numbers of a problem that may differ between those that are made ready together."""

SceneOf = Callable[[int], Scene]


@dataclass(frozen=True)
class ReadyLanes:
    """Lanes that have their numbers and their start; `Bundle.load_ready` sets one going."""

    work: Floats
    """(lanes, slots)."""
    runs: NDArray[np.void]
    """(lanes,) their runs."""
    first_energy: Floats
    """(lanes, 3) J: kinetic, potential and stored elastic energy."""


def make_ready(
    kernel: Kernel,
    tangents: Tangents | None,
    problems: Sequence[LaneProblem],
    scene_of: SceneOf,
    like: Floats | None = None,
) -> ReadyLanes:
    """Return lanes of problems that all have one scene, with the numbers of all (`Varied`).

    A lane has the bits that it would have alone.

    Parameters
    ----------
    kernel, tangents
        Of the lanes' structure.
    problems
        One; or some that are alike but for scenes' numbers, `DIFFERING`, starts and when events
        count; all starts are closed or none, and all have contacts or none.
    scene_of
        Returns the scene of a lane, for what cannot take all numbers at once.
    like : (slots,)
        Of a lane that has the scene's numbers already, which saves looking at it again.
    """
    size = (tangents or kernel).layout.size
    work, runs = np.zeros((size, len(problems))), np.zeros(len(problems), DTYPE)
    problem = problems[0] if len(problems) == 1 else _joined(kernel, problems, scene_of)
    every = Lane(kernel, tangents, work, slice(None), runs)
    try:
        with np.errstate(divide="raise", invalid="raise"):
            bind(every, problem, like)
            resting = resting_rates(problem.scene)
    except REFUSALS:
        resting = np.zeros((len(kernel.pairs), len(problems)))
        for i, one in enumerate(problems):
            scene = scene_of(i)
            bind(Lane(kernel, tangents, work, i, runs[i]), replace(one, scene=scene), like)
            resting[:, i] = resting_rates(scene)
    set_clocks(every.slots, work, runs)
    obstructed = _obstructed(problems, scene_of)
    resting = np.broadcast_to(resting.T, (len(problems), len(kernel.pairs))).T
    energies = np.empty((len(ENERGIES), len(problems)))
    columns = [kernel.rows.index(name) for name in ENERGIES]
    group = aligned_zeros(size, kernel.lanes)
    for first in range(0, len(problems), kernel.lanes):
        own = np.minimum(np.arange(first, first + kernel.lanes), len(problems) - 1)
        group[:] = work[:, own]
        lanes = Lane(kernel, tangents, group, slice(None), runs[own])
        begin(lanes, _of_lanes(problem.start, own), resting[:, own], obstructed[own])
        work[:, own] = group
        kernel.module.observe_rest(group)
        energies[:, own] = lanes["channel"][columns]
    runs["status"] = Status.RUNNING
    every["active"], every["next_due"] = 1.0, -np.inf
    return ReadyLanes(np.ascontiguousarray(work.T), runs, np.ascontiguousarray(energies.T))


def _obstructed(problems: Sequence[LaneProblem], scene_of: SceneOf) -> Flags:
    """Return (lanes,) where no tangent can follow the motion."""
    try:
        return np.full(len(problems), bool(tangent_obstacle(problems[0].scene)))
    except REFUSALS:
        return np.array([bool(tangent_obstacle(scene_of(i))) for i in range(len(problems))])


def _joined(kernel: Kernel, problems: Sequence[LaneProblem], scene_of: SceneOf) -> LaneProblem:
    """Return the problem of all lanes, whose numbers differ by lane."""
    one = problems[0]
    numbers = {
        name: together([getattr(problem, name) for problem in problems]) for name in DIFFERING
    }
    event = one.event
    if event is not None:
        late = together(problem.event.not_before for problem in problems if problem.event)
        event = replace(event, not_before=late)
    if one.start is not None:
        start = _joined_start([p.start for p in problems if p.start is not None])
    else:
        start = LaneStart(_own_starts(kernel, one.scene, len(problems), scene_of), closed=True)
    return replace(one, event=event, start=start, **numbers)


def _joined_start(starts: Sequence[LaneStart]) -> LaneStart:
    """Return starts of lanes as one, with states (states, lanes) and contacts (lanes, pairs)."""
    rates = [one.impact_rate for one in starts if one.impact_rate is not None]
    contacts = [one.contact for one in starts if one.contact is not None]
    return LaneStart(
        np.stack([one.state for one in starts], axis=1),
        np.stack(contacts) if contacts else None,
        np.stack(rates) if rates else None,
        together(one.period for one in starts),
        together(one.time for one in starts),
        starts[0].closed,
    )


def _of_lanes(start: LaneStart | None, lanes: Integers) -> LaneStart | None:
    """Return a start with the contacts (lanes, pairs) of some lanes."""
    if start is None or start.contact is None or start.impact_rate is None:
        return start
    contacts, rates = np.atleast_2d(start.contact), np.atleast_2d(start.impact_rate)
    return replace(start, contact=contacts[lanes], impact_rate=rates[lanes])


def _own_starts(kernel: Kernel, scene: Scene, count: int, scene_of: SceneOf) -> Floats:
    """Return the states of the scenes' own starts: (states,), or (states, lanes) if they differ."""
    for one in (None, scene_of(0)):
        try:
            return own_start(kernel, scene, one)
        except REFUSALS:
            continue
    return np.stack([own_start(kernel, scene_of(i)) for i in range(count)], axis=1)
