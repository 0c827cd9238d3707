"""Faults that may strike a service; a member is one file, or one line with another one's class."""

from typing import Final

from jointplay.chaos.faults.backends_terminated import BackendsTerminated
from jointplay.chaos.faults.broker_wiped import BrokerWiped
from jointplay.chaos.faults.catalogue_locked import CatalogueLocked
from jointplay.chaos.faults.clock_set import ClockSet
from jointplay.chaos.faults.connections_held import ConnectionsHeld
from jointplay.chaos.faults.cut_off import CutOff
from jointplay.chaos.faults.damaged import Damaged
from jointplay.chaos.faults.device_fails import DeviceFails
from jointplay.chaos.faults.disk_full import DiskFull
from jointplay.chaos.faults.fault import Fault
from jointplay.chaos.faults.garbage_handed_in import GarbageHandedIn
from jointplay.chaos.faults.killed import Killed
from jointplay.chaos.faults.power_lost import PowerLost
from jointplay.chaos.faults.stopped import Stopped
from jointplay.chaos.faults.wake_ups import WakeUps
from jointplay.chaos.processes import ROLES
from jointplay.solver.kernels.device.host_driver import FAILURES

FAULTS: Final[dict[str, Fault]] = {
    **{f"{role}-killed": Killed(role) for role in ROLES},
    "all-killed": Killed(),
    **{f"{role}-stopped": Stopped(role) for role in ROLES},
    "all-stopped": Stopped(),
    **{f"device-{how}": DeviceFails(how) for how in FAILURES},
    "power-lost": PowerLost(),
    "broker-wiped": BrokerWiped(),
    "catalogue-locked": CatalogueLocked(),
    "database-away": CutOff("database"),
    "backends-terminated": BackendsTerminated(),
    "store-away": CutOff("store"),
    "disk-full": DiskFull(),
    "damaged": Damaged(),
    "clock-set": ClockSet(),
    "wake-ups": WakeUps(),
    "connections-held": ConnectionsHeld(),
    "garbage-handed-in": GarbageHandedIn(),
}
"""By name; the names are those of `jointplay chaos --fault`."""

__all__ = ["FAULTS", "Fault"]
