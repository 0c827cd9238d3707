"""The whole of it: compute, draw, write."""

from pathlib import Path

from jointplay.paper import cases, pictures, report, runs
from jointplay.paper.processes import Report, processes
from jointplay.paper.size import Size

RUNS = "runs"
PAGE = "report.html"
_DRAWING_FROM = 0.85
"""Of the progress, computing; the rest draws."""


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
    with processes(count, most_calls=64 * len(chosen)) as crew:
        runs.compute(
            chosen,
            cases.kernels(size),
            stores,
            crew,
            lambda done, note: progress(_DRAWING_FROM * done, note),
        )
        drawn = pictures.pictures(stores, size)
        images = crew.make(
            [picture.call for picture in drawn],
            lambda done, note: progress(
                _DRAWING_FROM + (1.0 - _DRAWING_FROM) * done, f"drawing {note}"
            ),
        )
    page = folder / PAGE
    page.write_text(report.page(stores, size, list(zip(drawn, images, strict=True))), "utf-8")
    return page
