"""The folder that ``jointplay run`` writes.

``job.json`` (the filled-in job: running it repeats the result), ``results.zarr`` (the store),
``peaks.csv`` and ``figures/``.
"""

import re
from pathlib import Path

from jointplay.command_line.exits import Exit, Stopped

JOB_FILE = "job.json"
STORE = "results.zarr"
PEAKS_FILE = "peaks.csv"
FIGURES = "figures"


_JOB_ID = re.compile("[0-9A-HJKMNP-TV-Z]{26}")


def is_job_id(results: str) -> bool:
    """Tell whether ``OUT|ID`` is the id of a service's job, and no folder."""
    return _JOB_ID.fullmatch(results) is not None and not Path(results).exists()


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
