"""Contact force at each joint with play, one row for each run."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from jointplay.figures import page
from jointplay.paper.drawings.curves import FIRST, Compared, over_time, true_peak

_HEIGHT: Final = 30.0  # mm, of a panel


def draw(runs: Sequence[Compared], joints: Sequence[str]) -> bytes:
    """Draw the normal force of joints (columns) in runs (rows), soon after the start.

    True peaks are circled.
    """
    with page.style():
        figure, grid = page.panels(len(runs), len(joints), len(runs) * _HEIGHT + 4.0, share_x=True)
        for row, one in zip(grid, runs, strict=True):
            for axes, joint in zip(row, joints, strict=True):
                channel = f"{joint}.normal_force"
                over_time(axes, one, channel, 1.0, 0.5, FIRST)
                true_peak(axes, one, channel, 1.0, FIRST)
                axes.set_ylim(bottom=0.0)
                page.corner_text(axes, f"joint {joint}, {one.label}")
            row[0].set_ylabel("normal force [N]")
        for axes in grid[-1]:
            axes.set_xlabel("time [s]")
        figure.align_ylabels()
        return page.save(figure, "png")
