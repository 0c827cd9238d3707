"""Runs an admitted job, in slices that each return to Python within a quarter of a second."""

import math
from collections.abc import Iterator

from jointplay.solver.mechanics.assembly import assemble
from jointplay.solver.runs.admission import Admission
from jointplay.solver.runs.certificate.certificate import Certificate
from jointplay.solver.runs.dynamic_run import LANE, DynamicRun
from jointplay.solver.runs.ideal.run import IdealRun
from jointplay.solver.runs.lane_results import (
    out_of_time,
    whereabouts,
)
from jointplay.solver.runs.results import Slice, Summary


class Simulation:
    """One trajectory: `slices` computes it, `checkpoint` between slices restarts it bit for bit."""

    def __init__(self, admission: Admission, checkpoint: bytes | None = None) -> None:
        """Compile or load the kernel and set the start, or the checkpoint.

        Raises
        ------
        LimitExceeded
            The scene's equations are too long to compile.
        """
        self.admission = admission
        ideal = assemble(admission.scene).freedom_with_play == 0
        self._run: _Run = IdealRun(admission) if ideal else DynamicRun(admission)
        if checkpoint is not None:
            self._run.restore(checkpoint)

    def slices(self, most_seconds: float = math.inf) -> Iterator[Slice]:
        """Yield what each slice computed, until the run is over.

        Parameters
        ----------
        most_seconds
            Of computing, those before a checkpoint included: then the run fails, between slices.

        Raises
        ------
        SimulationFailed
            After everything that was computed has been yielded.
        """
        run = self._run
        for piece in run.slices():
            yield piece
            if run.seconds > most_seconds and piece.fraction < 1.0:
                where = whereabouts(run.bundle, LANE) if isinstance(run, DynamicRun) else ""
                raise out_of_time(most_seconds, piece.time, where)

    def checkpoint(self) -> bytes:
        """Return a restart point; valid between slices."""
        return self._run.checkpoint()

    def summary(self) -> Summary:
        """Return extremes and statistics of what has been computed so far."""
        return self._run.summary()

    def certificate(self) -> Certificate | None:
        """Return how far what has been computed can be believed; none if the job wants none."""
        return self._run.certificate()


_Run = DynamicRun | IdealRun
