"""Lanes of a device for the points of a study, and which studies those are."""

from __future__ import annotations

from functools import partial

from jointplay.records.failure import InvalidInput
from jointplay.solver.integrators import METHODS
from jointplay.solver.integrators.method import Rosenbrock
from jointplay.solver.kernels.device.bundle import DeviceBundle, Write
from jointplay.solver.kernels.device.compiled import code
from jointplay.solver.kernels.device.driver import Device, DeviceError
from jointplay.solver.kernels.device.lanes import BLOCK
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.emit.tangents import Tangents
from jointplay.solver.runs.admission import Admission
from jointplay.solver.runs.study.lane_group import Make
from jointplay.solver.runs.study.plan import Study

NO_MEMORY = "CUDA_ERROR_OUT_OF_MEMORY"
INSTEAD = "Leave 'device' out: the processor computes it."


def device_lanes(device: Device, study: Study, write: Write = code) -> Make:
    """Return what has the lanes of a study that `required_study` returned; see `LaneGroup`.

    `write` : see `DeviceBundle`.
    """
    return partial(_lanes, device, study, write)


def _lanes(
    device: Device,
    study: Study,
    write: Write,
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
            return DeviceBundle(
                device, kernel, count, tangents=tangents, energies=energies, write=write
            )
        except DeviceError as error:
            if NO_MEMORY not in str(error) or count == 1:
                raise
            count //= 2


def required_study(job: Study | Admission) -> Study:
    """Return a job that devices compute.

    Raises
    ------
    InvalidInput
        They do not, for the sake of the field that it names.
    """
    if type(job) is not Study:  # other kinds than of points side by side have types of their own
        kind = job.job["kind"]
        raise InvalidInput.at("/kind", f"A device computes no job of the kind '{kind}'. {INSTEAD}")
    if job.channels:
        raise InvalidInput.at("/channels", f"A device seeks no extremes of channels. {INSTEAD}")
    if isinstance(METHODS[job.method], Rosenbrock):
        raise InvalidInput.at("/method", f"A device computes explicit methods alone. {INSTEAD}")
    if "channel" in (job.job.get("section") or {}):
        detail = f"A device takes sections at drivers' angles and at onsets. {INSTEAD}"
        raise InvalidInput.at("/section", detail)
    return job
