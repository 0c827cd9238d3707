"""Displacement, velocity and acceleration of the output, with clearance and without."""

from collections.abc import Sequence
from typing import Final

from jointplay.figures import page
from jointplay.paper.drawings.curves import FIRST, Compared, over_time, true_peak

_PANELS: Final = (
    ("displacement", "displacement [mm]", 1e-3, None),
    ("velocity", "velocity [m/s]", 1.0, None),
    ("acceleration", "acceleration [m/s²]", 1.0, None),
    ("velocity", "velocity [m/s]", 1.0, FIRST),
    ("acceleration", "acceleration [m/s²]", 1.0, FIRST),
)
"""Channel, label, what one is in SI, and the end of the time shown [s]."""
_HEIGHT: Final = 26.0  # mm, of a panel


def draw(runs: Sequence[Compared], ideals: Sequence[Compared]) -> bytes:
    """Draw runs over the ideal mechanism's; true peaks of the acceleration are circled."""
    with page.style():
        figure, grid = page.panels(len(_PANELS), 1, len(_PANELS) * _HEIGHT + page.LEGEND_HEIGHT)
        for (axes,), (channel, label, factor, stop) in zip(grid, _PANELS, strict=True):
            for one in ideals:
                over_time(axes, one, channel, factor, 1.2, stop)
            for one in runs:
                over_time(axes, one, channel, factor, 0.5, stop)
                if channel == "acceleration":
                    true_peak(axes, one, channel, factor, stop)
            axes.set_ylabel(label)
        grid[-1][0].set_xlabel("time [s]")
        figure.align_ylabels()
        marks = {one.label: ("s", one.colour) for one in (*runs, ideals[0])}
        page.legend_of_marks(figure, marks)
        return page.save(figure, "png")
