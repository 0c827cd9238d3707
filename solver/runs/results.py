"""Results of a simulation: slices while it runs, a summary at any time."""

from dataclasses import dataclass
from typing import Any

from jointplay.records.peak import Peak
from jointplay.records.run_rows import RunRows


@dataclass(frozen=True, kw_only=True)
class Slice(RunRows):
    """Results since the last slice; the columns of steps are those of `dense_output.columns`."""

    time: float
    """Simulated time reached, s."""
    fraction: float
    """Part of the run that is done, 0..1."""


@dataclass(frozen=True)
class Summary:
    """Extremes of the selected channels, and what the run cost and conserved."""

    peaks: dict[str, Peak]
    statistics: dict[str, Any]
