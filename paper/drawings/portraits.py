"""Phase portrait soon after the start and Poincaré sections before and after settling."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Final

import numpy as np

from jointplay.figures import marks, page
from jointplay.storage.results import ResultReader
from jointplay.storage.studies import StudyReader

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_HEIGHT: Final = 42.0  # mm, of a row
_MILLI: Final = 1e-3
EARLY_LABEL: Final = "before settling"
LATE_LABEL: Final = "settled"


def draw(trajectory: Path, start: float, before: Path, after: Path, joints: Sequence[str]) -> bytes:
    """Draw one row for each joint: trajectory from `start` [s] on, and sections, both in x.

    Parameters
    ----------
    trajectory
        Store of a run.
    before, after
        Stores of studies with sections; of the first member of `after`.
    """
    run, early, late = ResultReader(trajectory), StudyReader(before), StudyReader(after)
    first, last = run.between(start, None)
    with page.style():
        size = len(joints) * _HEIGHT + page.LEGEND_HEIGHT
        figure, grid = page.panels(len(joints), 2, size)
        for row, joint in zip(grid, joints, strict=True):
            names = [f"{joint}.eccentricity{rate}_x" for rate in ("", "_rate")]
            _, path = run.history(names, first, last)
            position, rate = (path[name] / _MILLI for name in names)
            row[0].plot(position, rate, color=page.BLUE, linewidth=0.25, rasterized=True)
            for source, colour in ((early, page.GREY), (late, page.VERMILION)):
                _cloud(row[1], source, names, colour)
            for axes, what in zip(row, ("trajectory", "sections"), strict=True):
                axes.locator_params(axis="x", nbins=3)
                axes.set_xlabel("eccentricity x [mm]")
                page.corner_text(axes, f"joint {joint}, {what}")
            row[0].set_ylabel("rate [mm/s]")
        figure.align_ylabels()
        entries = {"trajectory": ("s", page.BLUE), f"section {EARLY_LABEL}": ("o", page.GREY)}
        page.legend_of_marks(figure, entries | {f"section {LATE_LABEL}": ("o", page.VERMILION)})
        return page.save(figure, "png")


def _cloud(axes: Axes, source: StudyReader, names: Sequence[str], colour: str) -> None:
    """Draw the sections of the first point."""
    position, rate = (source.sections(name, 0, 1).ravel() / _MILLI for name in names)
    diameter = max(marks.size(int(np.isfinite(position).sum())), 1.0)
    marks.draw_cloud(axes, position, rate, colour, diameter)
