"""Figures with a row for each run and a column for each joint: contact forces, journal paths."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from jointplay.figures import page
from jointplay.paper.drawings.curves import FIRST, Compared, over_time, true_peak
from jointplay.storage.results import ResultReader

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_MILLI = 1e-3
Panel = Callable[["Axes", Compared, str], None]


def draw_forces(runs: Sequence[Compared], joints: Sequence[str]) -> bytes:
    """Draw normal forces soon after the start; true peaks are circled."""
    return _draw(runs, joints, _force, 30.0, "time [s]", "normal force [N]", over_time=True)


def draw_paths(runs: Sequence[Compared], joints: Sequence[str]) -> bytes:
    """Draw paths of the journals' centres inside their clearance circles."""
    return _draw(runs, joints, _path, 41.0, "eccentricity x [mm]", "eccentricity y [mm]")


def _draw(
    runs: Sequence[Compared],
    joints: Sequence[str],
    panel: Panel,
    height: float,
    across: str,
    up: str,
    *,
    over_time: bool = False,
) -> bytes:
    """Draw panels of a height [mm], with labels across the bottom and up the left side."""
    with page.style():
        size = len(runs) * height + 4.0
        figure, grid = page.panels(len(runs), len(joints), size, share_x=over_time)
        for row, one in zip(grid, runs, strict=True):
            for axes, joint in zip(row, joints, strict=True):
                panel(axes, one, joint)
                page.corner_text(axes, f"joint {joint}, {one.label}")
            row[0].set_ylabel(up)
        for axes in grid[-1]:
            axes.set_xlabel(across)
        if over_time:
            figure.align_ylabels()
        return page.save(figure, "png")


def _force(axes: Axes, one: Compared, joint: str) -> None:
    channel = f"{joint}.normal_force"
    over_time(axes, one, channel, 1.0, 0.5, FIRST)
    true_peak(axes, one, channel, 1.0, FIRST)
    axes.set_ylim(bottom=0.0)


def _path(axes: Axes, one: Compared, joint: str) -> None:
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
