"""The folder that ``jointplay run`` writes.

``job.json`` (the filled-in job: running it repeats the result), ``results.zarr`` (the store),
``peaks.csv`` and ``figures/``.
"""

from pathlib import Path

from jointplay.command_line.exits import Exit, Stopped

JOB_FILE = "job.json"
STORE = "results.zarr"
PEAKS_FILE = "peaks.csv"
FIGURES = "figures"


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
    raise Stopped(Exit.BAD_INPUT, f"{folder} holds no results; give a folder of `jointplay run`.")
