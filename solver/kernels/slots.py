"""Where the driving loop finds quantities: whole numbers in an array, indexed by `Slot`."""

from __future__ import annotations

from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from jointplay.solver.kernels.layout import Layout


class Slot(IntEnum):
    """Index of the slots array: first counts, then the first slot of each quantity."""

    STATES = 0
    LEDGER = 1
    JOINTS = 2
    DRIVERS = 3
    ROWS = 4
    SIZE = 5
    NUMBERS = 6
    TIME = 7
    STEP = 8
    TRIED = 9
    ARRIVAL = 10
    STAGE_TIME = 11
    THETA = 12
    ACTIVE = 13
    ACCEPT = 14
    FLAG = 15
    NEXT_STEP = 16
    END = 17
    NEXT_DUE = 18
    MARKED = 19
    STAGE = 20
    TOTAL = 21
    GAP = 22
    MODE = 23
    IMPACT_RATE = 24
    BEFORE_TIME = 25
    PHASE = 26
    WOUND = 27
    CHANNEL = 28
    PREVIOUS = 29
    HIGHEST = 30
    LOWEST = 31
    HIGHEST_TIME = 32
    LOWEST_TIME = 33
    IMPACT_FLOOR = 34
    RESTART = 35
    ONSET_TIME = 36
    APPROACH = 37
    ONSET_TOTAL = 38
    OPENED = 39
    WEIGHT = 40
    TANGENT = 41
    TANGENT_IMPACT_RATE = 42
    TANGENT_GAP = 43
    STEPS = 44
    PACE_AT = 45
    STORED = 46
    STORED_START = 47


COUNTS = ("STATES", "LEDGER", "JOINTS", "DRIVERS", "ROWS", "SIZE")


def slots_of(layout: Layout, **counts: int) -> NDArray[np.int64]:
    """Look all slots up by name; `counts` gives the numbers of states, joints and so on."""
    slots = np.zeros(len(Slot), dtype=np.int64)
    slots[Slot.SIZE] = layout.size
    for name, count in counts.items():
        slots[Slot[name.upper()]] = count
    for slot in Slot:
        if slot.name in COUNTS:
            continue
        for spelling in (slot.name.lower(), f"{slot.name.lower()}0"):
            if spelling in layout:
                slots[slot] = layout[spelling]
    return slots
