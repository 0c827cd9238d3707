"""Path of the journal's centre in its bearing at each joint with play, one row for each run."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final

import numpy as np

from jointplay.figures import page
from jointplay.paper.drawings.curves import Compared
from jointplay.storage.results import ResultReader

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_HEIGHT: Final = 41.0  # mm, of a panel
_MILLI: Final = 1e-3


def draw(runs: Sequence[Compared], joints: Sequence[str]) -> bytes:
    """Draw paths at joints (columns) in runs (rows) inside their clearance circles."""
    with page.style():
        figure, grid = page.panels(len(runs), len(joints), len(runs) * _HEIGHT + 4.0)
        for row, one in zip(grid, runs, strict=True):
            for axes, joint in zip(row, joints, strict=True):
                _track(axes, one, joint)
            row[0].set_ylabel("eccentricity y [mm]")
        for axes in grid[-1]:
            axes.set_xlabel("eccentricity x [mm]")
        return page.save(figure, "png")


def _track(axes: Axes, one: Compared, joint: str) -> None:
    reader = ResultReader(one.store)
    names = [f"{joint}.eccentricity_{axis}" for axis in "xy"]
    _, path = reader.history(names)
    x, y = (path[name] / _MILLI for name in names)
    axes.plot(x, y, color=one.colour, linewidth=0.3, rasterized=True)
    clearance = (
        reader.attributes["scene"]["joints"][joint]["clearance"]["radial_clearance"] / _MILLI
    )
    angle = np.linspace(0.0, 2.0 * np.pi, 241)
    circle = (clearance * np.cos(angle), clearance * np.sin(angle))
    axes.plot(*circle, color=page.BLACK, linewidth=0.5, linestyle=(0, (4, 3)))
    reach = 1.1 * max(clearance, float(np.abs([x, y]).max()))
    axes.set_aspect("equal")
    axes.set(xlim=(-reach, reach), ylim=(-reach, reach))
    axes.set_xticks([-clearance, 0.0, clearance])
    axes.set_yticks([-clearance, 0.0, clearance])
    page.corner_text(axes, f"joint {joint}, {one.label}")
