"""A step of one lane, as the loop looks at it: what its functions take as `s`, one for all."""

# mypy: disable-error-code="no-untyped-call"

from typing import Any, NamedTuple

import numpy as np
from numba import types

from jointplay.solver.kernels.emit.functions import ADDRESSES, WORK, functions_at
from jointplay.solver.kernels.emit.slots import AT, Slots
from jointplay.solver.kernels.jit import inner_kernel, written_out
from jointplay.solver.kernels.loop.extremes.search.brackets import BRACKETS
from jointplay.solver.kernels.loop.runs import RUNS, Run
from jointplay.solver.kernels.loop.unowned_view import unowned

Addresses = Any
"""Structure of the kernel's functions; see `solver.kernels.emit.functions`."""


class Step(NamedTuple):
    """A lane's attempt at a step. Inlined, it costs nothing; else it is 30 numbers."""

    lane: int
    """Column of the work array."""
    run: Run
    at: Slots
    work: np.ndarray
    """All quantities of all lanes of the group, (slots, lanes)."""
    spare: np.ndarray
    """Room for instants inside this step, (slots, INSTANTS)."""
    brackets: np.ndarray
    """Room for those of a search; see `solver.kernels.loop.extremes.search.brackets`."""
    call: Addresses


class Group(NamedTuple):
    """Lanes that are advanced at once; each of them has a `Step`."""

    runs: np.ndarray
    """(lanes,) of `Run`."""
    at: Slots
    work: np.ndarray
    spare: np.ndarray
    brackets: np.ndarray
    call: Addresses


class Workspace(NamedTuple):
    """Lanes as Python gives them to kernels, and room for these to compute in."""

    addresses: np.ndarray
    """Addresses of the kernel's functions, by name, (1,); those of tangents may be 0."""
    slots: np.ndarray
    """Where quantities are in `work` and `spare`, (1,) of `Slots`, in kernels called `at`."""
    work: np.ndarray
    spare: np.ndarray
    runs: np.ndarray
    brackets: np.ndarray
    """These as in a `Group`."""


WORKSPACE = types.NamedTuple([ADDRESSES, AT, WORK, WORK, RUNS, BRACKETS], Workspace)
"""Its type in kernels."""


@written_out()
def group_of(given: Workspace) -> Group:
    """Return the lanes of a workspace; the caller keeps its arrays alive."""
    work, spare, brackets = unowned(given.work), unowned(given.spare), unowned(given.brackets)
    return Group(unowned(given.runs), given.slots[0], work, spare, brackets, given.addresses[0])


@written_out()
def step_of(lane: int, group: Group) -> Step:
    """Return the step that a lane attempts."""
    run = group.runs[lane]
    return Step(lane, run, group.at, group.work, group.spare, group.brackets, group.call)


@inner_kernel(forceinline=True)
def states_within(s: Step) -> None:
    """Evaluate the states at the instants of this step that `spare` has."""
    functions_at(s.call).states_within(s.work, s.spare, s.lane)


@inner_kernel(forceinline=True)
def gaps_within(s: Step) -> None:
    """Evaluate gaps and slips there."""
    functions_at(s.call).gaps_within(s.work, s.spare, s.lane)


@inner_kernel(forceinline=True)
def channels_within(s: Step) -> None:
    """Evaluate all channels there."""
    functions_at(s.call).channels_within(s.work, s.spare, s.lane)


@inner_kernel(forceinline=True)
def channels_around(s: Step) -> None:
    """Evaluate all channels at four instants of the step before and four of this one."""
    functions_at(s.call).channels_around(s.work, s.spare, s.lane)
