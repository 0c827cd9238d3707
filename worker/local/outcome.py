"""The end of a local run, as it is written beside its results."""

import json
from datetime import datetime
from math import isfinite
from pathlib import Path
from typing import Any, Final, get_args

from jointplay.records.job import ErrorClass, JobError
from jointplay.worker.local.folder import OUTCOME_FILE

_STATES: Final = ("succeeded", "failed", "cancelled")


def outcome_of(folder: Path) -> dict[str, Any]:
    """Return the state, error, times and progress of the run in a folder.

    Raises
    ------
    ValueError
        The file is not what a run writes.
    FileNotFoundError, NotADirectoryError
        There is none: the run was killed before it was written, or only its store was kept.
    """
    content = (folder / OUTCOME_FILE).read_bytes()
    try:
        found = json.loads(content)
        error, progress = found["error"], found["progress"]
        moments = [datetime.fromisoformat(found[name]) for name in ("started", "finished")]
        sound = (
            found["state"] in _STATES
            and (error is None) == (found["state"] != "failed")
            and (error is None or JobError.of(error).error_class in get_args(ErrorClass))
            and all(moment.tzinfo is not None for moment in moments)
            and isfinite(progress["time"])
            and 0.0 <= progress["fraction"] <= 1.0
        )
    except (TypeError, KeyError, OverflowError) as wrong:
        raise ValueError(f"{OUTCOME_FILE} is no outcome of a run") from wrong
    if not sound:
        raise ValueError(f"{OUTCOME_FILE} is no outcome of a run")
    return dict(found)
