"""Reasons of the verdicts of a study whose points are kept as numbers alone."""

from collections.abc import Iterable

from jointplay.records.study import StudySource
from jointplay.solver.nonlinear.grounds import grounds
from jointplay.solver.nonlinear.verdict import UNDECIDED, VERDICTS

_NAME = next(name for name, code in VERDICTS.items() if code == UNDECIDED)


def undecided_reasons(source: StudySource, points: Iterable[int]) -> dict[int, str]:
    """Return why those of some points that are undecided are so, by point, from their numbers."""
    verdicts, names, columns = source.verdicts, list(source.verdict_names), source.indicators
    if verdicts is None or _NAME not in names:
        return {}
    code, known = names.index(_NAME), {"verdict": float(UNDECIDED)}
    return {
        point: grounds({name: float(column[point]) for name, column in columns.items()} | known)
        for point in points
        if verdicts[point] == code
    }
