"""A question for values or extremes of a trajectory: all that an answer needs, as plain data."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.resolution import Resolution

ROUNDED = (
    "Computed on another processor, or by another version of the solver, than the run: values may"
    " differ from its own by rounding."
)
WHOLE = (
    "From {:.6g} s on, no steps are kept: extremes are those of the trajectory between two samples,"
    " at a time between them. See 'steps_limit'."
)


@dataclass(frozen=True)
class Question:
    """Values at `times`, extremes between `edges`, or else the works of all `steps`."""

    job: dict[str, Any]
    """The admitted job's document."""
    names: tuple[str, ...]
    """Channels, by name."""
    steps: Floats | None
    """(n, columns) accepted steps around the window, as stored; None: the motion needs none."""
    times: Floats | None = None
    """(m,) ascending, s."""
    edges: Floats | None = None
    """(bins + 1,) ascending, s."""
    methods: tuple[str, ...] = ()
    """Names of methods, by the numbers that the last column of steps has."""
    ranges: Floats | None = None
    """(names,) range of each channel in its run; 0 where it is not known."""
    evaluated: bool = True
    """Extremes are evaluated where they are; otherwise they are sharp enough, and sooner there."""


@dataclass(frozen=True)
class Answer:
    """Numbers that were asked for, or why there are none."""

    values: Floats | None
    """(m, names) values, or (bins, names, 4) extremes: lowest, its time, highest, its time; or
    (n, 5) when each step ends, s, and its works, J."""
    rounded: bool = False
    """The last steps did not end where the run went on, bit for bit: another processor rounds."""
    refused: str = ""
    """A sentence, where the steps cannot be made again here."""
    whole_from: float | None = None
    """Time, s, from which extremes are of whole intervals between samples."""
    resolution: Resolution | None = None
    """Source of the numbers: steps, the motion, intervals or samples."""

    @property
    def note(self) -> str:
        """Remark on how far the numbers hold; else empty."""
        notes = []
        if self.rounded:
            notes.append(ROUNDED)
        if self.whole_from is not None:
            notes.append(WHOLE.format(self.whole_from))
        return " ".join(notes)


def together(answers: Sequence[Answer]) -> Answer:
    """Return the answers to the pieces of a window as one; a refusal if any is one."""
    found = []
    for one in answers:
        if one.values is None:
            return one
        found.append(one.values)
    return Answer(np.concatenate(found), rounded=any(one.rounded for one in answers))
