"""A question for values or extremes of a trajectory: all that an answer needs, as plain data."""

from dataclasses import dataclass
from typing import Any

from jointplay.records.arrays import Floats


@dataclass(frozen=True)
class Question:
    """Either values at `times`, or extremes between `edges`."""

    job: dict[str, Any]
    """The admitted job's document."""
    names: tuple[str, ...]
    """Of channels."""
    steps: Floats | None
    """(n, columns) accepted steps around the window, as stored; None: the motion needs none."""
    times: Floats | None = None
    """(m,) ascending, s."""
    edges: Floats | None = None
    """(bins + 1,) ascending, s."""
    ranges: Floats | None = None
    """(names,) range of each channel in its run; 0 where it is not known."""


@dataclass(frozen=True)
class Answer:
    """Numbers that were asked for, or why there are none."""

    values: Floats | None
    """(m, names) values, or (bins, names, 4) extremes: lowest, its time, highest, its time."""
    rounded: bool = False
    """The last steps did not end where the run went on, bit for bit: another processor rounds."""
    refused: str = ""
    """A sentence, where the steps cannot be made again here."""
