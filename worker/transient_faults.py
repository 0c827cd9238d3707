"""Transient faults of the platform: a full disk, a catalogue that does not answer.

They never end a job: its block is given back, and tried again from its last restart point.
"""

import errno
from typing import Final

from jointplay.storage.catalogue.errors import Unavailable

TRANSIENT: Final = (OSError, Unavailable)
_FULL: Final = frozenset({errno.ENOSPC, errno.EDQUOT})


def is_full(fault: Exception) -> bool:
    """Whether a fault is that a disk is full."""
    if isinstance(fault, Unavailable):
        return fault.full
    return getattr(fault, "errno", None) in _FULL


def waits_for(fault: Exception) -> str:
    """Return what a job says that it does until a fault has passed; at most 32 characters."""
    if is_full(fault):
        return "waiting for room on the disk"
    if isinstance(fault, Unavailable):
        return "waiting for the catalogue"
    from jointplay.solver.kernels.device.driver import DeviceError  # of those who have one

    if isinstance(fault, DeviceError):
        return "waiting for a device"
    return "waiting for the object store"
