"""The first graphics processor, or, where there is none, this processor in its driver's place."""

from typing import NamedTuple

from jointplay.solver.kernels.device.bundle import Write
from jointplay.solver.kernels.device.compiled import code
from jointplay.solver.kernels.device.driver import Device, DeviceError
from jointplay.solver.kernels.device.host_driver import HostDriver
from jointplay.solver.kernels.device.named import HOST, written_for
from jointplay.solver.kinds import Study
from jointplay.solver.runs.study.device_lanes import device_lanes
from jointplay.solver.runs.study.lane_group import Make

MEMORY = 2**33
"""Bytes that this processor has in a device's place."""


class Opened(NamedTuple):
    """A device, what writes code for it, and whether it is one."""

    device: Device
    write: Write
    there: bool

    def lanes(self, study: Study) -> Make:
        """Return what has the lanes of a study."""
        return device_lanes(self.device, study, self.write)


def opened() -> Opened:
    """Return the device."""
    try:
        return Opened(Device(), code, there=True)
    except DeviceError:
        return Opened(Device(library=HostDriver(MEMORY)), written_for(HOST), there=False)
