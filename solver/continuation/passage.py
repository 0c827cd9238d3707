"""Sections, runs from one to another, and derivatives of the map that these are."""

import math
from dataclasses import dataclass

from jointplay.records.arrays import Floats
from jointplay.solver.continuation.closest_approach import NO_MARGINS, Margins


@dataclass(frozen=True)
class Section:
    """A value of the parameter, one of a second if that varies, too, and the state at a section.

    `state` is (states + pairs,): coordinates, speeds and inner states, then the latched impact rate
    of each pair, m/s: 0 where the pair is apart.
    """

    value: float
    state: Floats
    second: tuple[float, ...] = ()

    @property
    def values(self) -> tuple[float, ...]:
        """Values of what varies."""
        return (self.value, *self.second)

    def moved(self, state: Floats, value: float = 0.0, second: float = 0.0) -> "Section":
        """Return the section farther by a difference of each."""
        behind = tuple(one + second for one in self.second)
        return Section(self.value + value, self.state + state, behind)


@dataclass(frozen=True)
class Passage:
    """A run from a section to the one some periods later, or some crossings."""

    end: Floats
    """State there, as that of a `Section`."""
    onsets: int
    """Beginnings of contact."""
    steps: int
    """Accepted."""
    failure: str
    """Why the run did not come to its end, as a sentence; empty if it did."""
    nearest: float = math.nan
    """Distance from another impact, if that is watched; see `Approaches.nearest`."""
    duration: float = math.nan
    """s."""
    margins: Margins = NO_MARGINS
    """Distances from another number of impacts, of an orbit that tells them."""
    phases: tuple[int, ...] = ()
    """Number of times that each slip sticks and slides in a period, in turn, of such an orbit."""
    moved: float = 0.0
    """By how much closing loops moved its start, in the unit of the coordinate that moved most."""


@dataclass(frozen=True)
class Linear:
    """The map at a section, and its derivatives."""

    passage: Passage
    residual: Floats
    """(size,) the end less the start; 0 for a pair whose contact lasts throughout, and along cyclic
    coordinates."""
    jacobian: Floats
    """(size, size) of the end by the start; no row for these."""
    sensitivity: Floats
    """(size, 1) of the end by the parameter; of a second one there is another column."""
    alike: bool
    """Whether the runs beside have as many onsets: else an impact begins or ends here."""
    monodromy: Floats
    """(states + pairs, states + pairs) whose eigenvalues are the multipliers: the Jacobian, or the
    part of it that is of the section."""
    nearing: Floats
    """(size + 1,) derivatives of how near the run comes to another impact, if that is watched."""
