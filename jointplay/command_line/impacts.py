"""Impacts as rows: of JSON, or of comma-separated values."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from jointplay.client import Impacts


def impact_rows(
    impacts: "Impacts", start: float | None, stop: float | None
) -> list[dict[str, Any]]:
    """Return the contacts that begin from ``start`` to ``stop`` [s], in order of release."""
    from jointplay.records.impact import IMPACT_UNITS

    low = float("-inf") if start is None else start
    high = float("inf") if stop is None else stop
    names = ("joint", *IMPACT_UNITS)
    columns = (impacts.joint, *(getattr(impacts, name).tolist() for name in IMPACT_UNITS))
    rows = (dict(zip(names, row, strict=True)) for row in zip(*columns, strict=True))
    return [row for row in rows if low <= row["onset"] <= high]


def impact_lines(rows: Sequence[dict[str, Any]]) -> Iterator[str]:
    """Yield rows as lines of CSV, with 17 significant digits."""
    from jointplay.records.impact import IMPACT_UNITS
    from jointplay.records.text_tables import csv_lines

    titles = [f"{name} [{unit}]" for name, unit in IMPACT_UNITS.items()]
    columns = [[row[name] for row in rows] for name in ("joint", *IMPACT_UNITS)]
    yield from csv_lines(["joint", *titles], [columns])
