"""Lanes as Python gives them to the loop."""

from typing import Any, NamedTuple

from numpy.typing import NDArray

from jointplay.records.arrays import Floats


class Workspace(NamedTuple):
    """Lanes as Python gives them to kernels, and room for these to compute in."""

    addresses: NDArray[Any]
    """Addresses of the kernel's functions, by name, (1,); those of tangents may be 0."""
    slots: NDArray[Any]
    """Where quantities are in `work` and `spare`, (1,) of `Slots`, in kernels called `at`."""
    work: Floats
    """All quantities of all lanes of the group, (slots, lanes)."""
    spare: Floats
    """Room for instants inside a step, (slots, INSTANTS)."""
    runs: NDArray[Any]
    """(lanes,) of `Run`."""
    brackets: NDArray[Any]
    """Room for those of a search; see `solver.kernels.loop.extremes.search.brackets`."""
