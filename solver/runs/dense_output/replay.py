"""Stored steps of a run, made again: any channel at any time, bit for bit as it was sampled."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.emit.slots import LENGTH
from jointplay.solver.kernels.loop.entry_points import (
    extremes_in_steps,
    find_steps,
    make_again,
    states_in_steps,
)
from jointplay.solver.kernels.loop.extremes.search.brackets import SHARP
from jointplay.solver.kernels.loop.extremes.window.blank_book import blank_book
from jointplay.solver.kernels.loop.workspace import Workspace
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.runs.admission import Admission
from jointplay.solver.runs.dense_output.parts import cut
from jointplay.solver.runs.run_kernel import run_kernel

LANE = 0
BEHIND = 1e-6
"""Share of the last step by which an instant may be behind it: rounding of its time."""
LOOKED_AT = 8
"""Steps whose ends are compared with what follows."""

Source = tuple[str, float, float]
"""Channel that another is a multiple of, factor, and offset."""


class ProblemReplay:
    """A problem's equations, ready to make its steps again.

    Parameters
    ----------
    kernel
        That the steps were made with.
    problem
        That they are of.
    """

    def __init__(self, kernel: Kernel, problem: LaneProblem) -> None:
        self.kernel = kernel
        self._bundle = Bundle(self.kernel, [problem], watch=False)
        self.runs = self._bundle.runs[: self._bundle.width]
        self.runs[:] = self.runs[LANE]
        self.period = float(self.runs["period"][LANE])

    @property
    def workspace(self) -> Workspace:
        """Lanes for the kernels that make steps again."""
        return self._bundle.workspace(self._bundle.groups[0])

    @property
    def width(self) -> int:
        """Numbers in a row of a step."""
        return int(self.kernel.step_row.width)

    def begins(self, steps: Floats) -> Floats:
        """Return the times at which steps (n, width) begin, s."""
        return self.kernel.row.times(steps, self.period)

    def ends(self, steps: Floats) -> Floats:
        """Return the times at which steps (n, width) end, s."""
        return self.begins(steps) + steps[:, LENGTH]

    def channels(self, names: Sequence[str], steps: Floats, moments: Floats) -> Floats:
        """Return channels (m, names) at instants that are inside consecutive steps (n, width).

        moments : (m, 2) ascending instants, each the product of two numbers, s: with the index of
        a sample and the output step, values are those of that sample.

        Raises
        ------
        ValueError
            An instant is behind the last step.
        """
        found = np.empty(len(moments), np.int64)
        find_steps(self.runs, steps, moments, found)
        if len(found) and found[-1] == len(steps):
            late = float(np.prod(moments[-1])) - float(self.ends(steps[-1:])[0])
            if late > BEHIND * steps[-1, LENGTH]:
                raise ValueError("the steps end before the last instant")
            found = np.minimum(found, len(steps) - 1)
        rows = np.empty((len(moments), self.kernel.row.width))
        states_in_steps(self.workspace, steps, moments, found, rows)
        return self._bundle.observe(LANE, rows, self.rows(names))

    def works(self, steps: Floats) -> Floats:
        """Return works (n, 4) of steps (n, width), J, in the order of `records.works.WORKS`."""
        kernel = self.kernel
        _, found = self._made(steps)
        contact, friction, *elements = found.T[: kernel.losses]
        nothing = np.zeros(len(steps))
        drivers = found.T[kernel.losses :]
        return np.column_stack([contact, friction, sum(elements, nothing), sum(drivers, nothing)])

    def mismatch(self, steps: Floats) -> float:
        """Return how far steps, made again, end from where the next one starts, in its scales.

        0: bit for bit, as on the processor and with the solver that made them. Only a few are
        looked at; a step with one of another method, or of another scene, is far off.
        """
        if len(steps) < 2:
            return 0.0
        chosen = np.unique(np.linspace(0, len(steps) - 2, LOOKED_AT).astype(np.int64))
        columns = self.kernel.step_row
        states = slice(columns.state, columns.slope)
        ends, _ = self._made(steps[chosen])
        following = steps[chosen + 1, states]
        scale = np.abs(steps[:, states]).max(axis=0) + 1e-300
        return float((np.abs(ends - following) / scale).max())

    def _made(self, steps: Floats) -> tuple[Floats, Floats]:
        """Return states (n, states) that steps end with, and terms (n, terms) of their ledger."""
        kernel, count = self.kernel, len(steps)
        ends = np.empty((count, kernel.equations.states))
        works = np.empty((count, kernel.losses + len(kernel.equations.drivers)))
        make_again(self.workspace, np.ascontiguousarray(steps), ends, works)
        return ends, works

    def extremes(
        self,
        names: Sequence[str],
        steps: Floats,
        edges: Floats,
        ranges: Floats,
        *,
        evaluated: bool = True,
    ) -> Floats:
        """Return extremes (bins, names, 4) of channels: lowest, its time, highest, its time.

        They are those of the trajectory between bins' edges, whatever a grid would show; NaN of a
        bin outside the steps.

        Parameters
        ----------
        steps : (n, width)
            Consecutive steps.
        edges : (bins + 1,)
            Ascending times, s.
        ranges : (names,)
            Range of each channel in its run: extremes are sharp to 1e-6 of it.  0: not known, of
            the range in each bin.
        evaluated
            Extremes are values where they are. Otherwise they may be off by as much as sharp
            ones, and cost a fifth of it for a few channels, and a tenth for many.
        """
        sources, wanted = self.sought(names)
        known = np.zeros(len(wanted))
        for (name, factor, _), spread in zip(sources, ranges, strict=True):
            if factor:
                c = wanted.index(name)
                known[c] = max(known[c], spread / abs(factor))
        records = np.full((len(edges) - 1, len(wanted), 4), np.nan)
        parts, shares = cut(self.begins(steps), steps[:, LENGTH], edges)
        if len(parts):
            first, last = int(parts[0, 0]), int(parts[-1, 0]) + 1
            parts[:, 0] -= first
            extremes_in_steps(
                self.workspace,
                np.ascontiguousarray(steps[first:last]),
                parts,
                shares,
                self.rows(wanted),
                0.0 if evaluated else SHARP,
                self.book(wanted, known),
                records,
            )
        return scaled(records, wanted, sources)

    def sought(self, names: Sequence[str]) -> tuple[list[Source], list[str]]:
        """Return what channels are multiples of, and the channels that these are, by row."""
        rows = self.kernel.rows
        sources = [rows.multiples.get(name, (name, 1.0, 0.0)) for name in names]
        return sources, sorted({name for name, _, _ in sources}, key=rows.index)

    def book(self, wanted: Sequence[str], ranges: Floats) -> Floats:
        """Return the book of a first bin, with the ranges (wanted,) of wanted channels."""
        return blank_book(len(self.kernel.rows.names), self.rows(wanted), ranges)

    def rows(self, names: Sequence[str]) -> NDArray[np.int64]:
        """Return the rows of the channel block that channels have, (names,)."""
        return np.array([self.kernel.rows.index(name) for name in names], np.int64)


class Replay(ProblemReplay):
    """A job's equations with one method, ready to make its steps again.

    Parameters
    ----------
    admission
        Of the job that the steps are of.
    method
        Name of the method that made them.

    Raises
    ------
    LimitExceeded, CompilationEnded
        The equations cannot be compiled, or not so fast.
    """

    def __init__(self, admission: Admission, method: str) -> None:
        job = admission.job
        problem = LaneProblem(
            admission.scene,
            job["duration"],
            admission.tolerance,
            job["duration"],
            samples=0,
            sections=0,
            section_offset=0.0,
            step=job["step"],
        )
        super().__init__(run_kernel(admission, method), problem)


def scaled(records: Floats, wanted: list[str], sources: list[Source]) -> Floats:
    """Return records of channels that are multiples of those that were looked at."""
    found = np.stack([records[:, wanted.index(name)] for name, _, _ in sources], axis=1)
    for c, (_, factor, offset) in enumerate(sources):
        found[:, c, ::2] = factor * found[:, c, ::2] + offset
        if factor < 0.0:
            found[:, c] = found[:, c][:, [2, 3, 0, 1]]
    return found
