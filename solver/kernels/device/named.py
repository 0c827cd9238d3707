"""Devices by their names: `cuda:0` is the first graphics processor."""

import re

from jointplay.records.failure import InvalidInput
from jointplay.solver.kernels.device.driver import Device, DeviceError
from jointplay.solver.kernels.device.host_driver import HostDriver

HOST = "host"
"""This processor in the place of a device, to try without a card what needs one."""
NAMES = re.compile(r"cuda:(\d{1,4})")


def device_named(name: str) -> Device:
    """Return a device, opened.

    Raises
    ------
    InvalidInput
        There is none of this name, or no driver.
    """
    if name == HOST:
        return Device(library=HostDriver())
    named = NAMES.fullmatch(name)
    if named is None:
        detail = (
            f"{name!r} is no device; give 'cpu', 'auto', 'cuda:0', 'cuda:1' and so on, or 'host'."
        )
        raise InvalidInput.at("/device", detail)
    try:
        return Device(int(named[1]))
    except DeviceError as error:
        detail = f"{name!r} cannot be opened: {error}. Leave it out to compute on the processor."
        raise InvalidInput.at("/device", detail) from error
