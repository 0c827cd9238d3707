"""Figures that only the report has: runs over one another, and a run beside its sections."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from jointplay.figures import colours, marks, page, sampling, saving
from jointplay.figures.kind import Selection
from jointplay.figures.orbit import draw_clearance, frame
from jointplay.paper.cases import JOINTS
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.studies.reader import StudyReader

COLOURS: Final = (colours.PERIODIC, colours.COMPUTED, colours.MARKED)
"""One for each of the runs that are compared."""
_FIRST: Final = 0.4
"""s: in which the publication sees the motion settle from its start."""
_MILLI: Final = 1e-3
_RESPONSES: Final = (
    ("displacement", "displacement [mm]", _MILLI, None),
    ("velocity", "velocity [m/s]", 1.0, None),
    ("acceleration", "acceleration [m/s²]", 1.0, None),
    ("velocity", "velocity [m/s]", 1.0, _FIRST),
    ("acceleration", "acceleration [m/s²]", 1.0, _FIRST),
)
"""Channel, label, what one is in SI, and the end of the time shown [s]."""


@dataclass(frozen=True)
class Compared:
    """A run, its name in the legend, and its colour."""

    store: Path
    label: str
    colour: str


def draw_responses(runs: Sequence[Compared], ideals: Sequence[Compared]) -> bytes:
    """Draw the output over the ideal mechanism's; true peaks of the acceleration are circled."""
    with page.style():
        height = len(_RESPONSES) * 26.0 + page.LEGEND_HEIGHT
        figure, grid = page.panels(len(_RESPONSES), 1, height)
        for (axes,), (channel, label, factor, stop) in zip(grid, _RESPONSES, strict=True):
            for one in ideals:
                _over_time(axes, one, channel, factor, 1.2, stop)
            for one in runs:
                _over_time(axes, one, channel, factor, 0.5, stop)
                if channel == "acceleration":
                    _true_peak(axes, one, channel, stop)
            axes.set_ylabel(label)
        page.finish_stack(figure, [axes for (axes,) in grid], "time [s]")
        page.legend_of_marks(figure, {one.label: ("s", one.colour) for one in (*runs, ideals[0])})
        return saving.save(figure, "png")


def draw_forces(runs: Sequence[Compared], ideals: Sequence[Compared]) -> bytes:
    """Draw normal forces soon after the start; true peaks are circled."""
    return _by_joint(runs, _force, 30.0, ("time [s]", "normal force [N]"), same_time=True)


def draw_paths(runs: Sequence[Compared], ideals: Sequence[Compared]) -> bytes:
    """Draw paths of the journals' centres inside their clearance circles."""
    return _by_joint(runs, _path, 41.0, ("eccentricity x [mm]", "eccentricity y [mm]"))


def draw_portraits(trajectory: Path, start: float, before: Path, after: Path) -> bytes:
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
        figure, grid = page.panels(len(JOINTS), 2, len(JOINTS) * 42.0 + page.LEGEND_HEIGHT)
        for row, joint in zip(grid, JOINTS, strict=True):
            names = [f"{joint}.eccentricity{rate}_x" for rate in ("", "_rate")]
            _, path = run.history(names, first, last)
            position, rate = (path[name] / _MILLI for name in names)
            row[0].plot(position, rate, color=colours.COMPUTED, linewidth=0.25, rasterized=True)
            for source, colour in ((early, colours.AUXILIARY), (late, colours.MARKED)):
                position, rate = (source.sections(name, 0, 1).ravel() / _MILLI for name in names)
                diameter = max(marks.size(int(np.isfinite(position).sum())), 1.0)
                marks.draw_cloud(row[1], position, rate, colour, diameter)
            for axes, what in zip(row, ("trajectory", "sections"), strict=True):
                axes.locator_params(axis="x", nbins=3)
                axes.set_xlabel("eccentricity x [mm]")
                page.corner_text(axes, f"joint {joint}, {what}")
            row[0].set_ylabel("rate [mm/s]")
        figure.align_ylabels()
        entries = {
            "trajectory": ("s", colours.COMPUTED),
            "section before settling": ("o", colours.AUXILIARY),
            "section settled": ("o", colours.MARKED),
        }
        page.legend_of_marks(figure, entries)
        return saving.save(figure, "png")


def _by_joint(
    runs: Sequence[Compared],
    draw: Callable[[page.Axes, Compared, str], None],
    height: float,
    labels: tuple[str, str],
    *,
    same_time: bool = False,
) -> bytes:
    """Draw a row [mm] for each run and a column for each joint, labelled across and up."""
    with page.style():
        size = len(runs) * height + 4.0
        figure, grid = page.panels(len(runs), len(JOINTS), size, share_x=same_time)
        for row, one in zip(grid, runs, strict=True):
            for axes, joint in zip(row, JOINTS, strict=True):
                draw(axes, one, joint)
                page.corner_text(axes, f"joint {joint}, {one.label}")
            row[0].set_ylabel(labels[1])
        for axes in grid[-1]:
            axes.set_xlabel(labels[0])
        if same_time:
            figure.align_ylabels()
        return saving.save(figure, "png")


def _force(axes: page.Axes, one: Compared, joint: str) -> None:
    channel = f"{joint}.normal_force"
    _over_time(axes, one, channel, 1.0, 0.5, _FIRST)
    _true_peak(axes, one, channel, _FIRST)
    axes.set_ylim(bottom=0.0)


def _path(axes: page.Axes, one: Compared, joint: str) -> None:
    reader = ResultReader(one.store)
    names = [f"{joint}.eccentricity_{axis}" for axis in "xy"]
    _, path = reader.history(names)
    x, y = (path[name] / _MILLI for name in names)
    axes.plot(x, y, color=one.colour, linewidth=0.3, rasterized=True)
    declared = reader.attributes["scene"]["joints"][joint]["clearance"]
    clearance = declared["radial_clearance"] / _MILLI
    draw_clearance(axes, clearance, linewidth=0.5)
    frame(axes, 1.1 * max(clearance, float(np.abs([x, y]).max())))
    axes.set_xticks([-clearance, 0.0, clearance])
    axes.set_yticks([-clearance, 0.0, clearance])


def _over_time(
    axes: page.Axes, one: Compared, channel: str, factor: float, width: float, stop: float | None
) -> None:
    """Draw a channel over time [s] up to `stop`, in units of `factor`, all extremes included."""
    time, values = sampling.over_time(ResultReader(one.store), channel, Selection(stop=stop))
    axes.plot(time, values / factor, color=one.colour, linewidth=width, label=one.label)


def _true_peak(axes: page.Axes, one: Compared, channel: str, stop: float | None) -> None:
    """Circle the extreme of the larger magnitude that the solver found, unless it is later."""
    value, time = ResultReader(one.store).peaks()[channel].larger
    if stop is None or time <= stop:
        axes.plot([time], [value], "o", color=one.colour, markersize=3.5, **page.RING)
