"""Clouds of fine marks: as many as a picture can show, however many sections were recorded."""

from typing import Final

import numpy as np

from jointplay.figures import page
from jointplay.figures.turns import within_a_turn
from jointplay.records.arrays import Floats, Integers
from jointplay.records.channel import by_name
from jointplay.records.study import StudySource

MOST_VALUES: Final = 4_000_000
"""Most values of an observable in one picture; of more, every second, third, … section is taken."""
MOST_MARKS: Final = 100_000
"""Most marks of a colour; of more, those that lie within half a dot of each other become one."""
_DOTS: Final = 2000
_BLOCK: Final = 1_000_000
_LARGEST, _SMALLEST = 2.5, 0.4  # diameter, points


def sections(source: StudySource, observable: str, points: slice) -> Floats:
    """Give (points, k) values at sections, evenly chosen if there are more than can be shown.

    Angles that go round are within one turn.
    """
    count = points.stop - points.start
    stride = max(1, -(-count * source.record // MOST_VALUES))
    rows = max(1, _BLOCK // max(source.record, 1))
    parts = [
        source.sections(observable, first, min(first + rows, points.stop))[:, ::stride]
        for first in range(points.start, points.stop, rows)
    ]
    values = np.concatenate(parts)
    return (
        within_a_turn(values) if by_name(source.observables)[observable].unit == "rad" else values
    )


def size(count: int) -> float:
    """Choose the diameter [points] of marks: smaller the more there are in a panel."""
    return float(np.clip(60.0 / np.sqrt(max(count, 1)), _SMALLEST, _LARGEST))


def draw_cloud(axes: page.Axes, x: Floats, y: Floats, colour: str, diameter: float) -> None:
    """Draw marks of a diameter [points] at the finite ones of (n,) x and y."""
    finite = np.isfinite(x) & np.isfinite(y)
    x, y = _apart(x[finite], y[finite])
    axes.plot(
        x,
        y,
        linestyle="",
        marker="o",
        color=colour,
        markersize=diameter,
        markeredgewidth=0.0,
        rasterized=len(x) > page.MOST_VECTOR_MARKS,
    )


def _apart(x: Floats, y: Floats) -> tuple[Floats, Floats]:
    """Keep one of the marks that no printed page tells apart, if there are too many."""
    if len(x) <= MOST_MARKS:
        return x, y
    _, kept = np.unique(_cell(x) * _DOTS + _cell(y), return_index=True)
    return x[kept], y[kept]


def _cell(values: Floats) -> Integers:
    low, high = float(values.min()), float(values.max())
    span = high - low if high > low else 1.0
    return np.minimum((values - low) / span * _DOTS, _DOTS - 1).astype(np.int64)
