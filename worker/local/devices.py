"""Devices that local runs may name; nothing of them is loaded for the processor."""

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from jointplay.solver.kinds import Admission, Study
    from jointplay.solver.runs.study.lane_group import Make

Lanes = Callable[["Study"], "Make"]
"""From a study to what has its lanes, in the process that asks; see `device_lanes`."""
PROCESSOR, FIRST = "cpu", "auto"
"""Names beside those of devices; `FIRST`: the first device that serves, else the processor."""


def lanes_of(name: str, job: "Admission | Study") -> Lanes | None:
    """Return what opens the device of a name for a job; None: the processor computes it.

    Raises
    ------
    InvalidInput
        There is no device that was named, or it does not compute such a job.
    """
    if name == FIRST:
        name = first_device(job)
    if name == PROCESSOR:
        return None
    from jointplay.solver.kernels.device.named import device_named
    from jointplay.solver.runs.study.required_study import required_study

    required_study(job)
    device_named(name)
    return opener(name)


def first_device(job: "Admission | Study") -> str:
    """Return the name of the first device that serves and computes a job; else `PROCESSOR`."""
    from jointplay.records.failure import InvalidInput
    from jointplay.solver.runs.found_device import found_device
    from jointplay.solver.runs.study.required_study import required_study

    try:
        required_study(job)
    except InvalidInput:
        return PROCESSOR
    return found_device() or PROCESSOR


def opener(name: str) -> Lanes:
    """Return what opens the device of a name, such as ``cuda:0``, in the process that asks."""
    return partial(_opened, name)


def _opened(name: str, study: "Study") -> "Make":
    from jointplay.solver.kernels.device.named import device_named
    from jointplay.solver.runs.study.device_lanes import device_lanes

    return device_lanes(device_named(name), study)
