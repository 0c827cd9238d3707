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
    NEW_MEMORY = 18
    END = 19
    NEXT_DUE = 20
    PEAK = 21
    STAGE = 22
    SLOPE = 23
    Y = 24
    K1 = 25
    LEDGER_RATE = 26
    KLEDGER1 = 27
    TOTAL = 28
    GAP = 29
    MODE = 30
    IMPACT_RATE = 31
    BEFORE_TIME = 32
    PHASE = 33
    WOUND = 34
    CHANNEL = 35
    PREVIOUS = 36
    CHANGE = 37
    HIGHEST = 38
    LOWEST = 39
    HIGHEST_TIME = 40
    LOWEST_TIME = 41
    MASK = 42
    IMPACT_FLOOR = 43
    RESTART = 44
    ONSET_TIME = 45
    APPROACH = 46
    ONSET_TOTAL = 47
    OPENED = 48


COUNTS = ("STATES", "LEDGER", "JOINTS", "DRIVERS", "ROWS", "MASK_ROWS", "SIZE")
BLOCKS = {"K1": "k1_0", "KLEDGER1": "kledger1_0", "LEDGER_RATE": "ledger0"}
"""Quantities whose slots have other names than theirs."""


def slots_of(layout: Layout, **counts: int) -> NDArray[np.int64]:
    """Look all slots up by name; `counts` gives the numbers of states, joints and so on."""
    slots = np.zeros(len(Slot), dtype=np.int64)
    slots[Slot.SIZE] = layout.size
    for name, count in counts.items():
        slots[Slot[name.upper()]] = count
    for slot in Slot:
        if slot.name in COUNTS:
            continue
        name = BLOCKS.get(slot.name, slot.name.lower())
        for spelling in (name, f"{name}0"):
            if spelling in layout:
                slots[slot] = layout[spelling]
    return slots
