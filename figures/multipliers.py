"""Multipliers of the orbits of branches in the complex plane, beside the unit circle."""

import math
import re

import numpy as np

from jointplay.figures import colours, page
from jointplay.figures.branch import known_branches, missing
from jointplay.figures.kind import NotDrawable, Selection, StudyFigure
from jointplay.figures.quantity import scale
from jointplay.records.arrays import Floats
from jointplay.records.branch import VALUE, Branch
from jointplay.records.channel import by_name
from jointplay.records.study import StudySource

_WIDTH, _HEIGHT = 66.0, 28.0  # mm, of the plane, and of what is above and below it
_CIRCLE = np.linspace(0.0, 2.0 * math.pi, 241)
_FARTHEST = 3.0
"""Multipliers beyond are not drawn, and told of."""
_ROOM = 0.15


def _draw(source: StudySource, selection: Selection) -> page.Figure:
    found = [one for one in known_branches(source, selection) if not one.of]
    if not found:
        raise NotDrawable("No orbit of a branch has been found.")
    multipliers = np.concatenate([_multipliers(one) for one in found])
    parameter = source.parameters[0]
    values = np.concatenate([one.column(VALUE) for one in found])
    across = scale(parameter.unit, values)
    far = np.abs(multipliers) > _FARTHEST
    shown = np.isfinite(multipliers) & ~far
    sentence = _sentence(int(far.any(axis=1).sum()), len(multipliers))
    sentence = f"{sentence} {missing(source, selection)}".strip()
    real, imaginary = _limits(multipliers.real[shown]), _limits(multipliers.imag[shown])
    plane = _WIDTH * (imaginary[1] - imaginary[0]) / (real[1] - real[0])
    height = _HEIGHT + plane + page.caption_height(sentence)
    figure, ((axes,),) = page.panels(1, 1, height)
    page.caption(figure, sentence)
    axes.plot(np.cos(_CIRCLE), np.sin(_CIRCLE), color=colours.GEOMETRY, linewidth=0.7)
    drawn = axes.scatter(
        multipliers.real[shown],
        multipliers.imag[shown],
        s=4.0,
        c=np.broadcast_to(values[:, None], multipliers.shape)[shown] / across.factor,
        cmap=colours.MAP,
        linewidths=0.0,
        zorder=2.0,
    )
    bar = figure.colorbar(drawn, ax=axes, location="top", aspect=25.0)
    bar.ax.set_gid(page.WITHOUT_SCALE)
    bar.set_label(across.label(parameter.name))
    axes.set_xlim(*real)
    axes.set_ylim(*imaginary)
    axes.set_aspect("equal")
    axes.set_xlabel("real part of the multiplier [-]")
    axes.set_ylabel("imaginary part [-]")
    return figure


def _multipliers(branch: Branch) -> Floats:
    """Return the multipliers of each orbit, (orbits, multipliers), complex."""
    columns = {one.name: values for one, values in branch.columns.items()}
    count = sum(re.fullmatch(r"multiplier_\d+\.real", name) is not None for name in columns)
    return np.stack(
        [
            columns[f"multiplier_{k}.real"] + 1j * columns[f"multiplier_{k}.imaginary"]
            for k in range(1, count + 1)
        ],
        axis=1,
    )


def _limits(parts: Floats) -> tuple[float, float]:
    """Return what of an axis is shown: the circle and all these, with room beside."""
    low, high = parts.min(initial=-1.0), parts.max(initial=1.0)
    return float(low) - _ROOM, float(high) + _ROOM


def _sentence(far: int, orbits: int) -> str:
    """Return how many orbits have multipliers that are not in the picture; empty: none."""
    if not far:
        return ""
    return f"{far} of {orbits} orbits have a multiplier beyond {_FARTHEST:g}, which is not drawn."


def _chosen(source: StudySource, _selection: Selection) -> tuple[str, ...]:
    if "multiplier_1.real" not in by_name(source.observables):
        raise NotDrawable("Multipliers are drawn of a job of kind continuation.")
    return ()


MULTIPLIERS = StudyFigure(
    name="multipliers",
    title="Multipliers of periodic orbits, and the unit circle that they pass",
    uses=("start", "stop"),
    channels=_chosen,
    draw=_draw,
)
