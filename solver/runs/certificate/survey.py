"""Survey of what a certificate needs while a trajectory is computed."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats
from jointplay.records.channel import Channel
from jointplay.solver.kernels.emit.slots import TIME, DenseRow
from jointplay.solver.kernels.emit.tangents import compile_tangents
from jointplay.solver.kernels.loop.runs import SAMPLES
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.mechanics.absolute import AbsoluteMechanism
from jointplay.solver.mechanics.closing_rows import ClosingRow, closing_rows
from jointplay.solver.mechanics.kinematics import Kinematics
from jointplay.solver.mechanics.rows import Row
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.mechanics.view import view
from jointplay.solver.runs.certificate.certificate import Certificate, certify
from jointplay.solver.runs.certificate.companions import RUN, Companions
from jointplay.solver.runs.certificate.growth import Windows
from jointplay.solver.scene.document import Scene


class Violation:
    """The largest violation of a scene's constraints at all dense states seen so far."""

    def __init__(self, scene: Scene, formulation: str, row: DenseRow) -> None:
        self.row = row
        self.numbers = view(scene)
        self.drivers: Sequence[str] = tuple(scene.drivers)
        self.tree = spanning_tree(scene)
        self.absolute: AbsoluteMechanism | None = None
        if formulation == "lagrange":
            self.absolute = AbsoluteMechanism(scene, self.numbers, close_play=False)
        self.largest = np.zeros(2)
        """Largest violation of positions, m, and of angles, rad."""

    def examine(self, rows: Floats) -> None:
        """Look at dense states, (count, width), as `solver.kernels.loop.dense_rows` writes them."""
        if not len(rows):
            return
        clocks = rows[:, self.row.phase : self.row.wound] + rows[:, self.row.wound : self.row.state]
        driven = {
            name: clocks[:, k] + self.numbers.drivers[name].clock_rate * rows[:, TIME]
            for k, name in enumerate(self.drivers)
        }
        for row in self._rows(list(self.row.states(rows).T), driven):
            kind = 1 if row.part == "angle" else 0
            worst = float(np.max(np.abs(row.value)))
            self.largest[kind] = max(self.largest[kind], worst)

    def _rows(
        self, states: list[Floats], driven: Mapping[str, Floats]
    ) -> Sequence[Row] | Sequence[ClosingRow]:
        if self.absolute is not None:
            half = 3 * len(self.absolute.bodies)
            return self.absolute.rows(states[:half], states[half : 2 * half], driven)
        names = self.tree.coordinates
        position = dict(zip(names, states, strict=False))
        speed = dict(zip(names, states[len(names) :], strict=False))
        return closing_rows(Kinematics(self.tree, self.numbers, position, speed, driven))


class Survey:
    """Companions of the trajectory in a bundle's first lane, and after them its windows."""

    def __init__(self, bundle: Bundle, problem: LaneProblem, formulation: str) -> None:
        """Load companions; compile tangents, which takes seconds when they are not cached."""
        self.bundle, self.problem = bundle, problem
        self.tangents = compile_tangents(bundle.kernel)
        self.companions = Companions.beside(bundle, problem)
        self.violation: Violation | None = None
        if formulation == "lagrange" or spanning_tree(problem.scene).closing:
            self.violation = Violation(problem.scene, formulation, bundle.kernel.row)
        self.windows: Windows | None = None
        self.goes_on = True
        """True while something is left to compute."""

    @property
    def time(self) -> float:
        """Simulated time that all companions have reached that still run, s."""
        return self.companions.time

    def advance(self, budget: int) -> None:
        """Make at most `budget` attempts: of trajectory and companions, then of windows."""
        if self.bundle.lane(RUN).running:
            self._follow(budget)
            return
        self.bundle.advance(0)  # its rows have been handed out
        while budget > 0 and self.companions.running:
            budget -= self._follow(budget)
        if budget <= 0 or self.companions.running:
            return
        if self.windows is None:
            self.windows = self._windows()
        self.goes_on = self.windows.advance(budget)

    def _follow(self, budget: int) -> int:
        """Make attempts until a lane ends, at most `budget`. Returns how many."""
        before = self.bundle.attempts
        self.bundle.advance(self.companions.allowance(budget))
        self.companions.collect()
        if self.violation is not None:
            self.violation.examine(self.bundle.rows(SAMPLES, RUN))
        return self.bundle.attempts - before

    def go_on_with(self, bundle: Bundle, problem: LaneProblem) -> None:
        """Go on with the lanes of another method, to which all were handed over."""
        self.tangents = compile_tangents(bundle.kernel)
        self.bundle = self.companions.bundle = bundle
        self.problem = problem

    def checkpoint(self) -> dict[str, NDArray[Any]]:
        """Return arrays that `restore` takes."""
        saved = self.companions.checkpoint() | {"goes_on": np.array(self.goes_on)}
        if self.windows is not None:
            saved |= self.windows.checkpoint()
        if self.violation is not None:
            saved["violation"] = self.violation.largest
        return saved

    def restore(self, saved: Mapping[str, NDArray[Any]]) -> None:
        """Continue from a checkpoint."""
        self.companions.restore(saved)
        self.goes_on = bool(saved["goes_on"])
        if "windows_growth" in saved:
            self.windows = self._windows()
            self.windows.restore(saved)
        if self.violation is not None:
            self.violation.largest = np.array(saved["violation"])

    def _windows(self) -> Windows:
        return Windows(self.companions, self.problem, self.tangents)

    def certificate(self, channels: Sequence[Channel]) -> Certificate:
        """Return what is known by now of the trajectory's channels."""
        return certify(
            self.companions,
            self.problem.scene,
            channels,
            self.problem.tolerance,
            None if self.windows is None or self.goes_on else self.windows.exponent(),
            None if self.violation is None else self.violation.largest,
        )
