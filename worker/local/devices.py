"""Devices that local runs may name; nothing of them is loaded for the processor."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from jointplay.solver.kinds import Admission, Study
    from jointplay.solver.runs.study.lane_group import Make

PROCESSOR = "cpu"


def lanes_of(name: str, job: "Admission | Study") -> "Make | None":
    """Return what has a job's lanes on the device of a name; None: the processor computes it.

    Raises
    ------
    InvalidInput
        There is no such device, or it does not compute such a job.
    """
    if name == PROCESSOR:
        return None
    from jointplay.solver.kernels.device.named import device_named
    from jointplay.solver.runs.study.device_lanes import device_lanes, required_study

    study = required_study(job)
    return device_lanes(device_named(name), study)
