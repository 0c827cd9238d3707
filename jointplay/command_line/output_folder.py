"""The folder that ``jointplay run`` writes.

``job.json`` (the filled-in job: running it repeats the result), ``results.zarr`` (the store),
``peaks.csv`` of a simulation or ``points.csv`` of a study, and ``figures/``.
"""

from pathlib import Path
from typing import TYPE_CHECKING

from jointplay.command_line.exits import Exit, Stopped
from jointplay.job_id import is_job_id

if TYPE_CHECKING:
    from storage.results import ResultReader
    from storage.studies import StudyReader

JOB_FILE = "job.json"
STORE = "results.zarr"
PEAKS_FILE = "peaks.csv"
POINTS_FILE = "points.csv"
FIGURES = "figures"


def is_of_service(results: str) -> bool:
    """Tell whether ``OUT|ID`` is the id of a service's job, and no folder."""
    return is_job_id(results) and not Path(results).exists()


def store_in(folder: Path) -> Path:
    """Return the store in a run's folder; the store itself may be given too.

    Raises
    ------
    Stopped
        There is none.
    """
    for store in (folder / STORE, folder):
        if (store / "zarr.json").is_file():
            return store
    raise Stopped(
        Exit.BAD_INPUT,
        f"{folder} holds no results: give a folder that `jointplay run` made, or a job's id.",
    )


def results_in(folder: Path) -> "ResultReader | StudyReader":
    """Return the results in a run's folder: of a simulation, or of a study.

    Raises
    ------
    Stopped
        There are none.
    """
    from storage.results import NotAStore, ResultReader
    from storage.studies import StudyReader

    store = store_in(folder)
    try:
        return StudyReader(store)
    except NotAStore:
        return ResultReader(store)
