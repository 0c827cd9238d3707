"""Faults of the platform that may pass: a full disk, a catalogue that does not answer.

They never end a job: its block is given back, and tried again from its last restart point.
"""

import errno
from typing import Final

from jointplay.storage.catalogue.errors import Unavailable

PASSING: Final = (OSError, Unavailable)
_FULL: Final = frozenset({errno.ENOSPC, errno.EDQUOT})


def waits_for(fault: Exception) -> str:
    """Return what a job says that it does until a fault has passed; at most 32 characters."""
    if isinstance(fault, Unavailable) and not fault.full:
        return "waiting for the catalogue"
    if isinstance(fault, Unavailable) or getattr(fault, "errno", None) in _FULL:
        return "waiting for room on the disk"
    return "waiting for the results' place"
