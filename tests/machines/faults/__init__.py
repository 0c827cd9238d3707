"""Faults that strike a cluster; a member is one file, or one line with another one's class.

A member has `lasts`, shortest and longest time [s], and `strike`, which says what machine it
struck; none: the servers, and so everybody.
"""

from tests.machines.faults.broker_lost import BrokerLost
from tests.machines.faults.clock_set import ClockSet, KilledAsClockIsSet
from tests.machines.faults.database import BackendsTerminated, DatabaseRestarted
from tests.machines.faults.machine_killed import MachineKilled
from tests.machines.faults.network import BLACK_HOLE, LINK_CUT, Unreachable
from tests.machines.faults.store_refuses import StoreRefuses

FAULTS = {
    "link-cut": Unreachable(LINK_CUT),
    "joined-link-cut": Unreachable(LINK_CUT, "joined"),
    "servers-link-cut": Unreachable(LINK_CUT, "servers"),
    "black-hole": Unreachable(BLACK_HOLE),
    "joined-black-hole": Unreachable(BLACK_HOLE, "joined"),
    "servers-black-hole": Unreachable(BLACK_HOLE, "servers"),
    "door-link-cut": Unreachable(LINK_CUT, "door"),
    "machine-killed": MachineKilled(),
    "joined-killed": MachineKilled(joined=True),
    "database-restarted": DatabaseRestarted(),
    "backends-terminated": BackendsTerminated(),
    "broker-lost": BrokerLost(),
    "store-refuses": StoreRefuses(),
    "clock-set": ClockSet("machine"),
    "database-clock-set": ClockSet("database"),
    "broker-clock-set": ClockSet("broker"),
    "store-clock-set": ClockSet("store"),
    "killed-as-clock-set": KilledAsClockIsSet(),
}
"""By name; the names are those of `python -m tests.machines --fault`."""
