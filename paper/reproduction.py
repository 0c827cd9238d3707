"""The whole reproduction: compute, draw, write."""

from pathlib import Path

from jointplay.paper import cases, pictures, report, runs
from jointplay.paper.runs import Stores
from jointplay.paper.size import Size
from jointplay.solver.runs.processes import cores, processes
from jointplay.worker.local.computing import Report
from jointplay.worker.local.interruption import interruption

RUNS = "runs"
PAGE = "report.html"
_DRAWING_FROM = 0.85
"""Share of the progress that is computing; the rest is drawing."""


def reproduce(folder: Path, size: Size, count: int | None, progress: Report) -> Path:
    """Compute everything into a folder, on `count` processes, and return the report's path.

    Raises
    ------
    Interrupted
        By Ctrl-C.
    RunFailed
        A simulation failed.
    OSError
        The folder cannot be written.
    """
    chosen = cases.runs(size)
    stores = folder / RUNS
    with (
        interruption() as asked_to_end,
        processes(count or cores(), 64 * len(chosen), asked_to_end) as pool,
    ):
        runs.compute(
            chosen,
            cases.kernels(size),
            stores,
            pool,
            lambda done, note: progress(_DRAWING_FROM * done, note),
        )
        drawn = pictures.pictures(Stores(stores), size)
        images = pool.make(
            [picture.call for picture in drawn],
            lambda done, ended, note: progress(
                _DRAWING_FROM + (1.0 - _DRAWING_FROM) * done,
                f"drawing {ended} of {len(drawn)}: {note}",
            ),
        )
    page = folder / PAGE
    page.write_text(report.page(stores, size, list(zip(drawn, images, strict=True))), "utf-8")
    return page
