"""Figures drawn by two processes: this one, and one that gets ready while a job is computed.

Loading what draws takes as long as half of the figures of a short run, and computing it leaves a
core free.  The figures are claimed one by one from a pipe that both processes read, a byte a
figure, as `make` hands out its jobs: whoever is free takes the next one.
"""

import json
import os
import select
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import IO, TYPE_CHECKING, cast

from jointplay.solver.runs.processes import cores

if TYPE_CHECKING:
    from jointplay.solver.kinds import Admission, Study

PROGRAM = "jointplay.local.drawing_process"
_FEW = 3
"""Figures that one process has drawn before it would have shared them."""
_LONGEST = 60.0  # s without a figure, after which a process is lost


class SecondDrawer:
    """A process that is started here and draws, once figures are offered to it.

    Whatever becomes of it, and whatever it could not draw, is for the caller to draw: it is only
    asked which figures are there.  Ctrl-C does not reach it; it ends when `end` says so, or this
    process is gone.
    """

    def __init__(self) -> None:
        queue, offers = os.pipe()
        with ExitStack() as opened:  # closed again if there is no process to be had
            self._queue = opened.enter_context(open(queue, "rb", 0))
            self._offers = opened.enter_context(open(offers, "wb", 0))
            self._process = subprocess.Popen(  # noqa: S603 - our own program
                [sys.executable, "-P", "-m", PROGRAM, str(queue)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,  # what fails there is tried, and told, here
                bufsize=0,
                env=os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
                pass_fds=(queue,),
                process_group=0,
            )
            opened.pop_all()
        self._orders = cast("IO[bytes]", self._process.stdin)
        self._told = cast("IO[bytes]", self._process.stdout)

    @property
    def pid(self) -> int:
        """Process id."""
        return self._process.pid

    def share(self, results: Path, folder: Path, names: Sequence[str]) -> Iterator[int]:
        """Offer figures to both processes, and yield which of them the caller is to draw.

        Parameters
        ----------
        results
            Folder of a run.
        folder
            Where figures go.
        names
            Of figures, those that take longest first.
        """
        self._offers.write(bytes(range(len(names))))
        self._offers.close()
        order = {"results": str(results), "folder": str(folder), "names": list(names)}
        with suppress(OSError):  # it is gone: all are for the caller
            self._orders.write(json.dumps(order).encode() + b"\n")
        while claim := self._queue.read(1):
            yield claim[0]

    def drawn(self) -> set[int]:
        """Wait until the other process has nothing left to draw; tell what it has drawn."""
        found: set[int] = set()
        while select.select([self._told], [], [], _LONGEST)[0] and (news := self._told.read(64)):
            found.update(news)
        self.end()
        return found

    def end(self) -> None:
        """End the process, wherever it is; again changes nothing."""
        self._process.kill()
        self._process.wait()
        for pipe in (self._orders, self._told, self._queue, self._offers):
            pipe.close()


@contextmanager
def second_drawer(admission: "Admission | Study") -> Iterator[SecondDrawer | None]:
    """Start a second drawer for the figures of a job, if it will have a use for it."""
    if os.name != "posix" or cores() < 2 or _figures(admission) <= _FEW:
        yield None
        return
    try:
        drawer = SecondDrawer()
    except OSError:  # the system gives no process: then one has to do
        yield None
        return
    try:
        yield drawer
    finally:
        drawer.end()


def _figures(admission: "Admission | Study") -> int:
    """Count the figures that a job will have; none of a study, which leaves no core free."""
    import numpy as np

    from jointplay import figures
    from jointplay.records.channel import Channel
    from jointplay.records.run_in_memory import Dataset
    from jointplay.solver.kinds import Admission

    if not isinstance(admission, Admission):
        return 0
    channels = [Channel(one.name, one.unit) for one in admission.channels]
    planned = Dataset({"scene": admission.scene_document()}, channels, np.zeros(1), {})
    kinds = {kind.name for kind in figures.ROSTER}
    return sum(listed.name in kinds for listed in figures.available(planned))
