"""Faults that may strike a service; a member is one file, or one line with another one's class."""

from typing import Final

from jointplay.chaos.faults.fault import Fault
from jointplay.chaos.faults.killed import Killed
from jointplay.chaos.faults.stopped import Stopped
from jointplay.chaos.processes import ROLES

FAULTS: Final[dict[str, Fault]] = {
    **{f"{role}-killed": Killed(role) for role in ROLES},
    "all-killed": Killed(),
    **{f"{role}-stopped": Stopped(role) for role in ROLES},
    "all-stopped": Stopped(),
}
"""By name; the names are those of `jointplay chaos --fault`."""

__all__ = ["FAULTS", "Fault"]
