"""News of the points of a block, as lanes have given it since it was last asked for."""

from dataclasses import dataclass, field

from jointplay.records.point import PointEnd, SectionRows
from jointplay.solver.runs.study.point_run import PointRun


@dataclass
class PointNews:
    """Sections, and points that ended."""

    rows: list[SectionRows] = field(default_factory=list)
    ended: list[PointEnd] = field(default_factory=list)
    following: list[PointRun] = field(default_factory=list)
    """Points that wait from now on: they follow those that ended."""
