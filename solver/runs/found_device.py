"""The first device of this machine that is made for double precision."""

from collections.abc import Callable

from jointplay.solver.kernels.device.driver import Device, DeviceError
from jointplay.solver.runs.device_trial import HIGHEST_RATIO

MOST = 16
"""Devices that are looked at."""


def found_device(opened: Callable[[int], Device] = Device) -> str | None:
    """Return its name, such as ``cuda:0``; None: there is none, or no driver.

    `opened` : what opens the device of a number.
    """
    for number in range(MOST):
        try:
            if opened(number).ratio <= HIGHEST_RATIO:
                return f"cuda:{number}"
        except DeviceError:
            break
    return None
