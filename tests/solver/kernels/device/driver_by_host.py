"""The host's driver, which counts what is asked of it, and may be lost at a launch."""

from typing import Any

from jointplay.solver.kernels.device.host_driver import LOST, MEMORY, HostDriver


class DriverByHost(HostDriver):
    """Counts launches, and bytes that come back."""

    def __init__(self, memory: int = MEMORY) -> None:
        super().__init__(memory)
        self.launches = 0
        self.fetched = 0
        """Bytes that were copied from the device."""
        self.lost_at = -1
        """Number of the launch at which the device is lost."""

    def cuMemcpy2DUnaligned_v2(self, given: Any) -> int:  # noqa: N802
        self.fetched += given._obj.width * given._obj.height
        return super().cuMemcpy2DUnaligned_v2(given)

    def cuLaunchKernel(self, *given: Any) -> int:  # noqa: N802
        if self.launches == self.lost_at:
            return LOST
        self.launches += 1
        return super().cuLaunchKernel(*given)
