"""The page of a film: the mechanism above, its joints with play below, at any of its frames."""

from collections.abc import Callable
from typing import Final

import numpy as np

from jointplay.figures import between_samples, page, sampling, scene_facts
from jointplay.figures.animation import insets
from jointplay.figures.animation.instants import Instants
from jointplay.figures.animation.magnified import REACH
from jointplay.figures.kind import NotDrawable, Selection
from jointplay.figures.mechanism_geometry import Pose
from jointplay.figures.mechanism_marks import draw_gravity
from jointplay.figures.mechanism_scene import View, draw_placed, place
from jointplay.figures.quantity import scale
from jointplay.records.arrays import Floats
from jointplay.records.run import Source

_COLUMNS: Final = 3
_INSET_HEIGHT: Final = 36.0
"""Height of a row of magnified joints on the page [mm]."""
_REAL_TIME: Final = 0.995


def channels(source: Source, selection: Selection) -> tuple[str, ...]:
    """Name what a film is drawn from; `NotDrawable` if it was not stored."""
    bodies = scene_facts.scene(source).get("bodies")
    if not bodies:
        raise NotDrawable("The results carry no scene to draw.")
    joints = [name for names in insets.magnified(source, selection).values() for name in names]
    poses = [f"{body}.{one}" for body in bodies for one in ("x", "y", "theta")]
    return (*joints, *scene_facts.stored(source, poses))


class Reel:
    """A figure that shows one frame of a film at a time.

    Parameters
    ----------
    source
        The results.
    selection
        Joints to magnify, and the window of time.
    instants
        Of the frames.
    """

    def __init__(self, source: Source, selection: Selection, instants: Instants) -> None:
        self._scene = scene_facts.scene(source)
        self._instants = instants
        self._joints = insets.magnified(source, selection)
        self._poses = _poses(source, instants.times)
        names = [name for channels in self._joints.values() for name in channels]
        columns = _columns(source, names, instants.all)
        self._insets = insets.insets(self._scene, list(self._joints), columns)
        placed = [place(self._scene, pose) for pose in self._poses]
        corners = [corner for one in placed for corner in one.corners]
        self._frames = [one.within(corners) for one in placed]
        self._passing: list[Callable[[], None]] = []
        self._lay_out()

    def __len__(self) -> int:
        return len(self._frames)

    def show(self, frame: int) -> None:
        """Draw a frame in place of the one before."""
        for remove in self._passing:
            remove()
        before = {artist for axes in self.figure.axes for artist in axes.get_children()}
        draw_placed(self._axes, self._frames[frame], self._view.metres.factor)
        self._tell(self._instants.times[frame])
        at = self._instants.frames[frame]
        for (name, inset), panel in zip(self._insets.items(), self._panels, strict=True):
            inset.draw(panel, at, self._poses[frame])
            gap, depth = inset.magnified
            words = [f"{name}, {_newtons(inset.force(at))}", f"gap {_times(gap)}"]
            words += [f"penetration {_times(depth)}"] if depth > 0.0 else []
            page.corner_text(panel, "\n".join(words))
        drawn = [artist for axes in self.figure.axes for artist in axes.get_children()]
        self._passing = [artist.remove for artist in drawn if artist not in before]

    def _lay_out(self) -> None:
        """Make the figure, and draw what stays."""
        self._view = View.of(self._frames[0])
        rows = -(-len(self._insets) // _COLUMNS)
        heights = [self._view.page_height, *[_INSET_HEIGHT] * rows]
        columns = min(_COLUMNS, max(len(self._insets), 1))
        self.figure, grid = page.panels(1 + rows, columns, sum(heights), row_heights=heights)
        cells = grid[0][0].get_gridspec()
        assert cells is not None  # noqa: S101  (narrows the type)
        for axes in grid[0]:
            axes.remove()
        self._axes = self.figure.add_subplot(cells[0, :])
        in_order = [axes for row in grid[1:] for axes in row]
        self._panels = in_order[: len(self._insets)]
        for axes in in_order:
            axes.set_gid(page.WITHOUT_SCALE)
            axes.set_aspect("equal")
            axes.set(xlim=(-REACH, REACH), ylim=(-REACH, REACH))
            axes.set_axis_off()
        self._view.frame(self._axes)
        draw_gravity(self._axes, self._frames[0].shape)
        self.show(0)
        page.legend(self.figure, self._axes)

    def _tell(self, time: float) -> None:
        """Write the time above the mechanism, and how slow the film is."""
        rate = self._instants.rate
        slow = f", {slowness(rate)} times slower" if 0.0 < rate < _REAL_TIME else ""
        last = scale("s", self._instants.times)
        page.corner_text(self._axes, f"t = {time / last.factor:.4g} {last.unit}{slow}")


def slowness(rate: float) -> str:
    """Return how many times slower than real time a film is, in three digits, such as ``1000``."""
    return f"{float(f'{1.0 / rate:.3g}'):.12g}"


def _poses(source: Source, times: Floats) -> list[Pose]:
    """Return the pose of every body at each time."""
    bodies = list(scene_facts.scene(source)["bodies"])
    names = [f"{body}.{one}" for body in bodies for one in ("x", "y", "theta")]
    columns = _columns(source, names, times)
    rows = np.stack([columns[name] for name in names], axis=1).reshape(len(times), -1, 3)
    return [
        {body: (x, y, angle) for body, (x, y, angle) in zip(bodies, row, strict=True)}
        for row in rows.tolist()
    ]


def _columns(source: Source, names: list[str], times: Floats) -> dict[str, Floats]:
    """Return channels at times: of the trajectory if it is known, else between two samples."""
    exact = between_samples.at(source, names, times)
    if exact is not None:
        return exact[1]
    first, last = source.between(float(times[0]), float(times[-1]))
    time, columns = sampling.joined(source, names, max(first - 1, 0), min(last + 1, source.samples))
    return {name: np.interp(times, time, columns[name]) for name in names}


def _newtons(force: float) -> str:
    if np.isnan(force):
        return "unknown"
    newtons = scale("N", np.array([force]))
    return f"{force / newtons.factor:.3g} {newtons.unit}" if force > 0.0 else "no contact"


def _times(factor: float) -> str:
    return f"×{float(f'{factor:.2g}'):g}"
