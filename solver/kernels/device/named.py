"""Devices by their names: `cuda:0` is the first graphics processor."""

import re

from jointplay.records.failure import InvalidInput
from jointplay.solver.kernels.device.driver import Device, DeviceError

NAMES = re.compile(r"cuda:(\d{1,4})")


def device_named(name: str) -> Device:
    """Return a device, opened.

    Raises
    ------
    InvalidInput
        There is none of this name, or no driver.
    """
    named = NAMES.fullmatch(name)
    if named is None:
        detail = f"{name!r} is no device; give 'cpu', 'auto', or 'cuda:0', 'cuda:1' and so on."
        raise InvalidInput.at("/device", detail)
    try:
        return Device(int(named[1]))
    except DeviceError as error:
        detail = f"{name!r} cannot be opened: {error}. Leave it out to compute on the processor."
        raise InvalidInput.at("/device", detail) from error
