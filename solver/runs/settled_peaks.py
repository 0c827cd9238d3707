"""Extremes of channels from the time on that a job leaves out as settling."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats
from jointplay.records.peak import Peak
from jointplay.solver.kernels.emit.slots import LENGTH
from jointplay.solver.kernels.loop.entry_points import extremes_in_steps
from jointplay.solver.kernels.loop.extremes.search.brackets import SHARP
from jointplay.solver.runs.admission import Admission
from jointplay.solver.runs.dense_output.parts import cut
from jointplay.solver.runs.dense_output.replay import ProblemReplay, Replay, scaled


class SettledPeaks:
    """Smallest and largest values after settling, whose bits do not depend on slices.

    The run's own record goes from its start: it decides what is looked at closely, so that the
    trajectory's results have the same bits whatever is left out here.

    Parameters
    ----------
    replay
        Of the run.
    names
        Channels.
    settle, end
        Of the time that counts, s.
    """

    def __init__(
        self, replay: ProblemReplay, names: Sequence[str], settle: float, end: float
    ) -> None:
        self._replay, self._names = replay, names
        self._edges = np.array([settle, end])
        self._sources, self._wanted = self._replay.sought(names)
        self._rows = self._replay.rows(self._wanted)
        self._book = self._replay.book(self._wanted, np.zeros(len(self._wanted)))
        self._record = np.full((1, len(self._wanted), 4), np.nan)

    def go_on_with(self, admission: Admission, method: str) -> None:
        """Take steps of another method from here on."""
        self._replay = Replay(admission, method)

    def add(self, steps: Floats) -> None:
        """Look at further steps (n, width)."""
        if not len(steps):
            return
        begins = self._replay.begins(steps)
        parts, shares = cut(begins, steps[:, LENGTH], self._edges)
        if not len(parts):
            return
        first, last = int(parts[0, 0]), int(parts[-1, 0]) + 1
        parts[:, 0] -= first
        extremes_in_steps(
            self._replay.workspace,
            np.ascontiguousarray(steps[first:last]),
            parts,
            shares,
            self._rows,
            SHARP,
            self._book,
            self._record,
        )

    def peaks(self) -> dict[str, Peak]:
        """Return the extremes so far, by channel; none before the motion has settled."""
        if np.isnan(self._record).all():
            return {}
        rows = scaled(self._record, self._wanted, self._sources)[0].tolist()
        return {name: Peak(*row) for name, row in zip(self._names, rows, strict=True)}

    def state(self, name: str) -> dict[str, NDArray[Any]]:
        """Return what the next call depends on, as arrays of a checkpoint."""
        return {f"{name}/record": self._record, f"{name}/book": self._book.copy()}

    def restore(self, saved: Mapping[str, NDArray[Any]], name: str) -> None:
        """Continue from `state`, bit for bit."""
        self._record = saved[f"{name}/record"].copy()
        self._book = saved[f"{name}/book"].copy()
