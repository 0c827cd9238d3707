"""Violation of the constraints of absolute coordinates: Baumgarte's drift alone."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from jointplay.solver.kernels.emit.places import TIME, DenseRow
from jointplay.solver.mechanics.absolute import AbsoluteMechanism
from jointplay.solver.mechanics.view import view
from jointplay.solver.scene.document import Scene

Floats = NDArray[np.float64]


class Violation:
    """The largest violation of a scene's constraints at all dense states seen so far.

    Attributes
    ----------
    largest : (2,)
        Of positions, m, and of angles, rad.
    """

    def __init__(self, scene: Scene, row: DenseRow) -> None:
        self.row = row
        self.numbers = view(scene)
        self.drivers: Sequence[str] = tuple(scene.drivers)
        self.mechanism = AbsoluteMechanism(scene, self.numbers, close_play=False)
        self.largest = np.zeros(2)

    def look(self, rows: Floats) -> None:
        """Look at dense states, (count, width), as `solver.kernels.loop.dense_rows` writes them."""
        if not len(rows):
            return
        angles = rows[:, self.row.phase : self.row.wound] + rows[:, self.row.wound : self.row.state]
        driven = {
            name: angles[:, k] + self.numbers.drivers[name].speed * rows[:, TIME]
            for k, name in enumerate(self.drivers)
        }
        half = 3 * len(self.mechanism.bodies)
        states = self.row.states(rows).T
        q, v = states[:half], states[half : 2 * half]
        for row in self.mechanism.rows(list(q), list(v), driven):
            kind = 1 if row.part == "angle" else 0
            worst = float(np.max(np.abs(row.value)))
            self.largest[kind] = max(self.largest[kind], worst)
