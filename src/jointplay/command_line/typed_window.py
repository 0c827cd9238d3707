"""A window of a job's results as it is typed: --start and --stop."""

import math
from typing import TYPE_CHECKING

from jointplay.command_line.exits import Stopped

if TYPE_CHECKING:
    from jointplay.client import Job


def check_ends(start: float | None, stop: float | None) -> None:
    """Refuse what is no window of any job, with `Stopped`."""
    for option, value in (("--start", start), ("--stop", stop)):
        if value is not None and not math.isfinite(value):
            raise Stopped(f"{option} {value}: give a time in seconds.")
    if start is not None and stop is not None and start > stop:
        raise Stopped(f"--stop {stop:g} is before --start {start:g}; swap them.")


def check_start(job: "Job", start: float | None) -> None:
    """Refuse, with `Stopped`, to look at a simulation after its end; points of a study are none."""
    if start is None or job.is_study:
        return
    duration = float(job.job["duration"])
    if start > duration:
        raise Stopped(f"--start {start:g} is after the end of {job.id} at {duration:g} s.")
