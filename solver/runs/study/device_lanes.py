"""Lanes of a device for the points of a study."""

from __future__ import annotations

from functools import partial

from jointplay.solver.kernels.device.driver import Device, DeviceError
from jointplay.solver.kernels.device.lanes import BLOCK
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.emit.tangents import Tangents
from jointplay.solver.lanes.device_bundle import DeviceBundle
from jointplay.solver.runs.study.lane_group import Make
from jointplay.solver.runs.study.plan import Study

NO_MEMORY = "CUDA_ERROR_OUT_OF_MEMORY"


def device_lanes(device: Device, study: Study) -> Make:
    """Return what has the lanes of a study that `required_study` returned. See `LaneGroup`."""
    return partial(_lanes, device, study)


def _lanes(
    device: Device,
    study: Study,
    kernel: Kernel,
    *,
    watch: bool,
    tangents: Tangents | None,
    keep_steps: int,
) -> DeviceBundle:
    """Return a block of lanes for each multiprocessor, or fewer.

    As many as the study has points, or as there is memory for.
    """
    if watch or keep_steps:
        raise ValueError("lanes of a device seek no extremes")
    count, energies = min(BLOCK * device.processors, study.points), study.keeps_ledger
    while True:
        try:
            return DeviceBundle(device, kernel, count, tangents=tangents, energies=energies)
        except DeviceError as error:
            if NO_MEMORY not in str(error) or count == 1:
                raise
            count //= 2
