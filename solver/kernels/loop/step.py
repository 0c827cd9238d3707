"""A step of one lane, as the loop looks at it: what its functions take as `s`, one for all."""

from typing import Any, NamedTuple

import numpy as np

from jointplay.solver.kernels.emit.slots import Slots
from jointplay.solver.kernels.jit import inner_kernel, written_out
from jointplay.solver.kernels.loop import generated
from jointplay.solver.kernels.loop.runs import Run
from jointplay.solver.kernels.loop.unowned_view import unowned
from jointplay.solver.kernels.loop.workspace import Workspace

Addresses = Any
"""Structure of the kernel's functions; see `solver.kernels.emit.functions`."""


class Step(NamedTuple):
    """A lane's attempt at a step, of a `Workspace`. Inlined, it costs nothing; else 30 numbers."""

    lane: int
    """Column of the work array."""
    run: Run
    at: Slots
    work: np.ndarray
    spare: np.ndarray
    brackets: np.ndarray
    addresses: Addresses


class Group(NamedTuple):
    """Lanes that are advanced at once; each of them has a `Step`."""

    runs: np.ndarray
    """(lanes,) of `Run`."""
    at: Slots
    work: np.ndarray
    spare: np.ndarray
    brackets: np.ndarray
    addresses: Addresses


@written_out()
def group_of(given: Workspace) -> Group:
    """Return the lanes of a workspace; the caller keeps its arrays alive."""
    work, spare, brackets = unowned(given.work), unowned(given.spare), unowned(given.brackets)
    return Group(unowned(given.runs), given.slots[0], work, spare, brackets, given.addresses[0])


@written_out()
def step_of(lane: int, group: Group) -> Step:
    """Return the step that a lane attempts."""
    run = group.runs[lane]
    return Step(lane, run, group.at, group.work, group.spare, group.brackets, group.addresses)


@inner_kernel(forceinline=True)
def states_within(s: Step) -> None:
    """Evaluate the states at the instants of this step that `spare` has."""
    generated.states_within(s.addresses, s.work, s.spare, s.lane)


@inner_kernel(forceinline=True)
def penetrations_within(s: Step) -> None:
    """Evaluate gaps and slips there."""
    generated.penetrations_within(s.addresses, s.work, s.spare, s.lane)


@inner_kernel(forceinline=True)
def channels_within(s: Step) -> None:
    """Evaluate all channels there."""
    generated.channels_within(s.addresses, s.work, s.spare, s.lane)


@inner_kernel(forceinline=True)
def channels_around(s: Step) -> None:
    """Evaluate all channels at four instants of the step before and four of this one."""
    generated.channels_around(s.addresses, s.work, s.spare, s.lane)
