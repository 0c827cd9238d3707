"""Branches of periodic orbits over a bifurcation diagram of the same parameter."""

from collections.abc import Sequence

import numpy as np

from jointplay.figures import colours, marks, page, study_facts
from jointplay.figures.kind import NotDrawable, at_most
from jointplay.figures.parameter_axis import ParameterAxis
from jointplay.figures.quantity import Scale, alike
from jointplay.figures.special_names import Placed
from jointplay.figures.turns import beside
from jointplay.records.branch import VALUE, Branch
from jointplay.records.channel import by_name
from jointplay.records.study import StudySource

KIND = "bifurcation"
_MOST_PANELS, _SHOWN = 6, 4
_HEIGHT, _SINGLE_HEIGHT = 40.0, 65.0  # mm


class OverDiagram:
    """Panels with the sections of a diagram, on which orbits have their positions."""

    def __init__(self, source: StudySource, over: StudySource, names: tuple[str, ...]) -> None:
        """Choose the channels, of `names` or of those that both have.

        NotDrawable: the diagram has another parameter, or there is no such channel.
        """
        own, other = source.parameters[0].name, over.parameters[0].name
        if own != other:
            sentence = f"The diagram is over {other}, these orbits over {own}."
            raise NotDrawable(f"{sentence} Take one of the same parameter.", "over")
        self._over = over
        self._points = slice(0, over.points)
        self._axis = ParameterAxis(over, 0, self._points)
        self.names = at_most(_MOST_PANELS, names) or _shared(source, over)
        known = by_name(over.observables)
        if missing := [name for name in self.names if name not in known]:
            raise NotDrawable(f"The diagram has no channel {missing[0]!r}.", "channels")
        self._rows = [marks.sections(over, name, self._points) for name in self.names]
        units = [known[name].unit for name in self.names]
        self._scales: list[Scale] = list(alike(units, self._rows))

    def panels(self, legend: int) -> tuple[page.Figure, list[page.Axes]]:
        """Return a figure with a panel for each channel, with the sections, and the panels."""
        heights = [_SINGLE_HEIGHT if len(self.names) == 1 else _HEIGHT] * len(self.names)
        figure, panels = page.stack(heights, legend)
        across = np.repeat(self._axis.shown, self._rows[0].shape[1])
        for axes, name, rows, unit in zip(
            panels, self.names, self._rows, self._scales, strict=True
        ):
            size = marks.size(int(np.count_nonzero(np.isfinite(rows))))
            marks.draw_cloud(axes, across, rows.ravel() / unit.factor, colours.NO_VERDICT, size)
            axes.lines[-1].set_label("sections")
            axes.set_ylabel(page.in_lines(unit.label(name)))
            self._axis.dress(axes)
        return figure, list(panels)

    def placed(self, branches: Sequence[Branch], panel: int) -> list[Placed]:
        """Return branches and where their orbits are in a panel.

        NotDrawable: none of them has an orbit within the diagram's values.
        """
        name, rows, found, seen = self.names[panel], self._rows[panel], [], False
        for branch in branches:
            across, values = branch.column(VALUE) / self._axis.factor, branch.column(name)
            low, *_, high = self._axis.edges
            seen = seen or bool(((low <= across) & (across <= high)).any())
            if by_name(self._over.observables)[name].unit == "rad":
                values = beside(values, rows)
            found.append((branch, across, values / self._scales[panel].factor))
        if not seen:
            sentence = "No orbit lies within the values of the diagram; take one of the same range."
            raise NotDrawable(sentence, "over")
        return found

    def finish(self, figure: page.Figure, panels: list[page.Axes]) -> None:
        """Explain the lines of the first panel, and name the parameter."""
        page.finish_stack(figure, panels, self._axis.label, panels[0])


def _shared(source: StudySource, over: StudySource) -> tuple[str, ...]:
    """Return the first channels that orbits and diagram have, moving ones first."""
    known = by_name(source.observables)
    positions = [position for position, _ in study_facts.moving_pairs(over)]
    names = positions or [one.name for one in over.observables]
    if not (found := tuple(name for name in names if name in known)[:_SHOWN]):
        sentence = "Orbits and diagram have no channel in common; name some as 'observables'."
        raise NotDrawable(sentence, "over")
    return found
