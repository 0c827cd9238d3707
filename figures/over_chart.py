"""Branches and curves of periodic orbits over the map of a chart of the same parameters."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from jointplay.figures import page
from jointplay.figures.chart_map import KINDS, ChartMap, offered
from jointplay.figures.kind import NotDrawable
from jointplay.figures.special_names import Placed
from jointplay.records.arrays import Floats
from jointplay.records.branch import SECOND, VALUE, Branch
from jointplay.records.study import StudySource

_HEIGHT = 70.0  # mm


class OverChart:
    """A panel with the map of a chart, on which orbits of a continuation have their positions."""

    def __init__(self, source: StudySource, over: StudySource) -> None:
        """Find which parameter is along which axis.

        NotDrawable: the chart has another axis, or the position along one is not known.
        """
        if over.kind not in KINDS:
            sentence = (
                f"Curves are drawn over a job of kind {' or '.join(KINDS)}, branches over one of"
                f" kind bifurcation, too; this one is of kind {over.kind}."
            )
            raise NotDrawable(sentence, "over")
        self._map = ChartMap(over, offered(over)[0])
        self._names = [one.name for one in source.parameters]
        self._fixed: dict[str, float] = {}
        axes = [self._map.across.name, self._map.up.name]
        for name in axes:
            if name not in self._names:
                self._fixed[name] = _fixed(source, name)
        if missing := [name for name in self._names if name not in axes]:
            sentence = f"The chart is over {' and '.join(axes)}, these orbits over {missing[0]}."
            raise NotDrawable(f"{sentence} Take one of the same parameters.", "over")

    def panel(self, labels: int) -> tuple[page.Figure, page.Axes]:
        """Return a figure with the map, with room to explain so many lines, and its panel."""
        shown, rows = self._map, page.legend_rows([*self._map.legend, *range(labels)])
        height = _HEIGHT + page.AXIS_HEIGHT + rows * page.LEGEND_HEIGHT
        figure, ((axes,),) = page.panels(1, 1, height + page.caption_height(shown.caption))
        page.caption(figure, shown.caption)
        shown.draw(figure, axes)
        axes.set_xlim(shown.across.edges[0], shown.across.edges[-1])
        axes.set_ylim(shown.up.edges[0], shown.up.edges[-1])
        return figure, axes

    def explain(self, figure: page.Figure, axes: page.Axes) -> None:
        """Explain the map's colours, and the lines of the panel."""
        page.legend_of_marks(figure, self._map.legend, axes)

    def placed(self, branches: Sequence[Branch]) -> list[Placed]:
        """Return branches, without special orbits beyond the map, and where their orbits are.

        NotDrawable: none of the orbits is on the map.
        """
        found, seen = [], False
        for branch in branches:
            across, up = self._positions(branch)
            (left, *_, right), (low, *_, high) = self._map.across.edges, self._map.up.edges
            within = (left <= across) & (across <= right) & (low <= up) & (up <= high)
            seen = seen or bool(within.any())
            shown = tuple(one for one in branch.special if within[one.row])
            found.append((replace(branch, special=shown), across, up))
        if not seen:
            sentence = "No orbit lies within the axes of the chart; take one of the same ranges."
            raise NotDrawable(sentence, "over")
        return found

    def _positions(self, branch: Branch) -> tuple[Floats, Floats]:
        """Return (orbits,) positions of a branch's orbits along both axes."""
        values = {name: np.full(len(branch.column(VALUE)), at) for name, at in self._fixed.items()}
        for name, column in zip(self._names, (VALUE, SECOND), strict=False):
            values[name] = branch.column(column)
        across, up = (values[one.name] / one.factor for one in (self._map.across, self._map.up))
        return across, up


def halo() -> list[Any]:
    """Return the effect by which a line stands out from any colour beneath."""
    from matplotlib.patheffects import withStroke

    return [withStroke(linewidth=2.0, foreground="white")]


def _fixed(source: StudySource, name: str) -> float:
    """Return the value of a parameter that does not vary in a job; NotDrawable: it has none."""
    given = source.attributes["job"]["scene"].get("parameters", {}).get(name)
    value = given.get("default") if isinstance(given, Mapping) else given
    if not isinstance(value, int | float):
        sentence = f"The chart's other axis is {name}, of which these orbits tell no value."
        raise NotDrawable(f"{sentence} Take a chart over the parameter that varies.", "over")
    return float(value)
