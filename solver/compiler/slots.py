"""Where the driving loop finds quantities: whole numbers in an array, indexed by `Slot`."""

from __future__ import annotations

from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from solver.compiler.layout import Layout


class Slot(IntEnum):
    """Index of the slots array: first counts, then the first slot of each quantity."""

    STATES = 0
    LEDGER = 1
    JOINTS = 2
    DRIVERS = 3
    ROWS = 4
    MASK_ROWS = 5
    SIZE = 6
    NUMBERS = 7
    TIME = 8
    STEP = 9
    TRIED = 10
    ARRIVAL = 11
    STAGE_TIME = 12
    THETA = 13
    ACTIVE = 14
    ACCEPT = 15
    FLAG = 16
    NEXT_STEP = 17
    END = 18
    NEXT_DUE = 19
    PEAK = 20
    STAGE = 21
    TOTAL = 22
    GAP = 23
    MODE = 24
    IMPACT_RATE = 25
    BEFORE_TIME = 26
    PHASE = 27
    WOUND = 28
    CHANNEL = 29
    PREVIOUS = 30
    HIGHEST = 31
    LOWEST = 32
    HIGHEST_TIME = 33
    LOWEST_TIME = 34
    MASK = 35
    IMPACT_FLOOR = 36
    RESTART = 37
    ONSET_TIME = 38
    APPROACH = 39
    ONSET_TOTAL = 40
    OPENED = 41


COUNTS = ("STATES", "LEDGER", "JOINTS", "DRIVERS", "ROWS", "MASK_ROWS", "SIZE")


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
