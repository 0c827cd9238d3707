"""Reasons of the verdicts of a study, also of those that are kept as numbers alone."""

from collections.abc import Iterable

from jointplay.records.study import StudySource
from jointplay.solver.nonlinear.verdict import UNDECIDED, VERDICTS, grounds

_NAME = next(name for name, code in VERDICTS.items() if code == UNDECIDED)


def reasons_of(source: StudySource, points: Iterable[int]) -> list[str | None]:
    """Return the reason of each point's verdict; None where there is none.

    Charts and basins keep no sentences: of their undecided points the numbers tell it.
    """
    verdicts, kept, names = source.verdicts, source.reasons, list(source.verdict_names)
    if verdicts is None:
        return [None for _ in points]
    code = names.index(_NAME) if _NAME in names else None
    columns = source.indicators

    def told(point: int) -> str | None:
        if point in kept or code is None or verdicts[point] != code:
            return kept.get(point)
        numbers = {name: float(column[point]) for name, column in columns.items()}
        return grounds(numbers | {"verdict": float(UNDECIDED)}) or None

    return [told(point) for point in points]
