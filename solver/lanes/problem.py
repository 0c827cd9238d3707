"""The problem of a lane, and its start."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats
from jointplay.solver.kernels.emit.slots import PERIOD, TIME, DenseRow
from jointplay.solver.kernels.loop.runs import SectionKind
from jointplay.solver.scene.document import Scene


@dataclass(frozen=True)
class Event:
    """A Poincare section that no clock gives: an onset of a pair, or a channel at a value."""

    kind: SectionKind
    index: int
    """Index of the contact pair, or row of the channel block."""
    value: float = 0.0
    sense: float = 1.0
    """1: the channel comes from below; -1: from above."""
    turn: float = 0.0
    """After how much the channel, an angle, is back; 0: never."""
    not_before: float = 0.0
    """Time from which events count, s."""


@dataclass(frozen=True)
class LaneStart:
    """Where a lane starts instead of at the scene's own start."""

    state: Floats
    """Coordinates, then speeds."""
    contact: NDArray[np.bool_] | None = None
    """Pairs that are in contact already, with their latched impact rates (m/s)."""
    impact_rate: Floats | None = None
    period: int = 0
    """Whole periods of the drivers that have passed."""
    time: float = 0.0
    """Since then, s."""
    closed: bool = False
    """Whether loops are closed already: else they are, which moves the start by its rounding."""

    @classmethod
    def at_section(cls, numbers: Floats, states: int) -> LaneStart:
        """Return the start at a section: so many states, and impact rates that may be left out."""
        if len(numbers) == states:
            return cls(numbers)
        rates = numbers[states:]
        return cls(numbers[:states].copy(), rates > 0.0, rates.copy())

    @classmethod
    def at_row(cls, row: Floats, columns: DenseRow) -> LaneStart:
        """Return the start at a row of dense state, (width,)."""
        touching = row[columns.mode : columns.impact_rate] > 0.0
        rates = row[columns.impact_rate : columns.width]
        return cls(columns.states(row), touching, rates, int(row[PERIOD]), row[TIME])


@dataclass(frozen=True)
class LaneProblem:
    """The problem that one lane computes."""

    scene: Scene
    duration: float
    tolerance: float
    output_step: float
    samples: int
    sections: int
    """Number of the section that follows the last one wanted; of events, how many."""
    section_offset: float
    first_section: int = 0
    event: Event | None = None
    start: LaneStart | None = None
    step: float | None = None
    """Step of a method with a fixed one, s."""
    first_sample: int = 0
    """Index of the first sample; sample i lies at i * output_step, the last one at the end."""
    ledger: bool = True
    """Whether works and impulses are added up, a tenth of a step's work; else they stay 0."""
    tangent_forgets: int = 0
    """Whole periods after which a tangent forgets latched impact rates; 0: never."""
