"""The first graphics processor, or, where there is none, this processor in its driver's place."""

from typing import NamedTuple

from jointplay.solver.kernels.device.driver import Device, DeviceError
from jointplay.solver.kernels.device.host_driver import HostDriver
from jointplay.solver.kinds import Study
from jointplay.solver.runs.study.device_lanes import device_lanes
from jointplay.solver.runs.study.lane_group import Make

MEMORY = 2**33
"""Bytes that this processor has in a device's place."""


class Opened(NamedTuple):
    """A device, and whether it is one."""

    device: Device
    there: bool

    def lanes(self, study: Study) -> Make:
        """Return what has the lanes of a study."""
        return device_lanes(self.device, study)


def opened() -> Opened:
    """Return the device."""
    try:
        return Opened(Device(), there=True)
    except DeviceError:
        return Opened(Device(library=HostDriver(MEMORY)), there=False)
