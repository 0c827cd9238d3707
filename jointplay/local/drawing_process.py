"""All figures of a job into files, with a second process that shares the work.

It loads matplotlib while the job is computed: loading takes as long as drawing half of the figures
of a short run, and computing that leaves a core free.  Both processes claim figures one by one from
a pipe, a byte a figure, as `make` hands out its jobs.
"""

import json
import os
import select
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import IO, TYPE_CHECKING, Final, cast

from jointplay.progress import progress
from jointplay.solver.runs.processes import cores

if TYPE_CHECKING:
    from jointplay.client import Job
    from jointplay.solver.kinds import Admission, Study

_SLOWEST: Final = ("certificate", "spectrum", "phase-portrait", "outputs", "contact-force", "orbit")
"""Figures that take longest to draw, begun first."""
_FEW = 3
"""Figures that one process has drawn before it would have shared them."""
_LONGEST = 60.0  # s without a figure, after which a process is lost


def draw_all(job: "Job", folder: Path, second: "DrawingProcess | None" = None) -> None:
    """Draw every kind of figure that the results allow into a folder, made if it is missing.

    A single output is not drawn once more on its own: the figure of all outputs shows it.  With a
    second process, which draws some of them, the job is one in a folder.
    """
    from jointplay import figures

    rank = {name: place for place, name in enumerate(_SLOWEST)}
    known = {**figures.ROSTER, **figures.STUDY_ROSTER}
    names = [name for name in job.figures if name in known]
    names.sort(key=lambda name: rank.get(name, len(rank)))
    folder.mkdir(parents=True, exist_ok=True)
    with progress("figures") as report:
        drawn: set[int] = set()
        for place in () if second is None else second.share(Path(job.id), folder, names):
            report(place / len(names), names[place])
            with suppress(Exception):  # drawn again below, it says why
                job.figure(names[place]).save(folder / names[place])
                drawn.add(place)
        if second is not None:
            drawn |= second.drawn()
        for place, name in enumerate(names):
            if place not in drawn:
                report(place / len(names), name)
                job.figure(name).save(folder / name)
        report(1.0, "")


class DrawingProcess:
    """A process that draws the figures that are offered to it.

    The caller draws what this process did not, for whatever reason.  Ctrl-C does not reach it; it
    ends when `end` is called or its parent is gone.
    """

    def __init__(self) -> None:
        queue, offers = os.pipe()
        with ExitStack() as opened:  # closed again if there is no process to be had
            self._queue = opened.enter_context(open(queue, "rb", 0))
            self._offers = opened.enter_context(open(offers, "wb", 0))
            self._process = subprocess.Popen(  # noqa: S603 - our own program
                [sys.executable, "-P", "-m", "jointplay.local.drawing_program", str(queue)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,  # the caller tries again, and reports
                bufsize=0,
                env=os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
                pass_fds=(queue,),
                process_group=0,
            )
            opened.pop_all()
        self._orders = cast("IO[bytes]", self._process.stdin)
        self._news = cast("IO[bytes]", self._process.stdout)

    @property
    def pid(self) -> int:
        """Process id."""
        return self._process.pid

    def share(self, results: Path, folder: Path, names: Sequence[str]) -> Iterator[int]:
        """Offer figures of the run in `results` to both processes; yield which to draw here."""
        self._offers.write(bytes(range(len(names))))
        self._offers.close()
        order = {"results": str(results), "folder": str(folder), "names": list(names)}
        with suppress(OSError):  # it is gone: the caller draws all
            self._orders.write(json.dumps(order).encode() + b"\n")
        while claim := self._queue.read(1):
            yield claim[0]

    def drawn(self) -> set[int]:
        """Wait until the other process has nothing left to draw; tell what it has drawn."""
        found: set[int] = set()
        while select.select([self._news], [], [], _LONGEST)[0] and (news := self._news.read(64)):
            found.update(news)
        self.end()
        return found

    def end(self) -> None:
        """End the process, wherever it is; again changes nothing."""
        self._process.kill()
        self._process.wait()
        for pipe in (self._orders, self._news, self._queue, self._offers):
            pipe.close()


@contextmanager
def drawing_process(admission: "Admission | Study") -> Iterator[DrawingProcess | None]:
    """Start a process for the figures of a job, if it has many and a core is free."""
    process = None
    if os.name == "posix" and cores() > 1 and _figures(admission) > _FEW:
        with suppress(OSError):  # no process to be had
            process = DrawingProcess()
    try:
        yield process
    finally:
        if process is not None:
            process.end()


def _figures(admission: "Admission | Study") -> int:
    """Count the figures that a job will have; none of a study, which leaves no core free."""
    import numpy as np

    from jointplay import figures
    from jointplay.records.channel import Channel
    from jointplay.records.run import Dataset
    from jointplay.solver.kinds import Admission

    if not isinstance(admission, Admission):
        return 0
    channels = [Channel(one.name, one.unit) for one in admission.channels]
    planned = Dataset({"scene": admission.scene_document()}, channels, np.zeros(1), {})
    return sum(listed.name in figures.ROSTER for listed in figures.available(planned))
