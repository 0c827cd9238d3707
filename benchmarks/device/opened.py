"""The first graphics processor, or, where there is none, this processor in its driver's place."""

from functools import partial
from typing import NamedTuple

from jointplay.solver.kernels.device.bundle import Write
from jointplay.solver.kernels.device.compiled import code
from jointplay.solver.kernels.device.driver import Device, DeviceError
from jointplay.solver.kernels.device.kernel_text import kernel_text
from jointplay.solver.kinds import Study
from jointplay.solver.runs.study.device_lanes import device_lanes
from jointplay.solver.runs.study.lane_group import Make
from tests.solver.kernels.device.driver_by_host import DriverByHost


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
        memory = 2**33
        driver = DriverByHost(memory)
        return Opened(Device(library=driver), partial(kernel_text, on_host=True), there=False)
