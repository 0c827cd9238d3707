"""The slots that the driving loop reads, as a tuple of whole numbers that kernels are not."""

from typing import NamedTuple

from solver.compiler.layout import Layout


class Slots(NamedTuple):
    """First slot of each quantity in the work array, and how many there are."""

    states: int
    ledger: int
    joints: int
    drivers: int
    rows: int
    mask_rows: int
    size: int
    numbers: int
    time: int
    step: int
    tried: int
    arrival: int
    stage_time: int
    theta: int
    active: int
    accept: int
    flag: int
    next_step: int
    new_memory: int
    end: int
    next_due: int
    peak: int
    stage: int
    slope: int
    y: int
    k1: int
    ledger_rate: int
    kledger1: int
    total: int
    gap: int
    mode: int
    impact_rate: int
    before_time: int
    phase: int
    wound: int
    channel: int
    previous: int
    change: int
    highest: int
    lowest: int
    highest_time: int
    lowest_time: int
    candidate: int
    mask: int
    impact_floor: int
    restart: int
    onset_time: int
    approach: int
    onset_total: int


def slots_of(
    layout: Layout, states: int, ledger: int, joints: int, drivers: int, rows: int, mask_rows: int
) -> Slots:
    """Look the slots up by name."""
    return Slots(
        states=states,
        ledger=ledger,
        joints=joints,
        drivers=drivers,
        rows=rows,
        mask_rows=mask_rows,
        size=layout.size,
        numbers=layout["numbers"],
        ledger_rate=layout["ledger0"],
        y=layout["y0"],
        k1=layout["k1_0"],
        kledger1=layout["kledger1_0"],
        **{name: layout[name] for name in SINGLE},
        **{name: layout[f"{name}0"] if f"{name}0" in layout else 0 for name in BLOCKS},
    )


SINGLE = (
    "time",
    "step",
    "tried",
    "arrival",
    "stage_time",
    "theta",
    "active",
    "accept",
    "flag",
    "next_step",
    "new_memory",
    "end",
    "next_due",
    "peak",
    "before_time",
)
BLOCKS = (
    "stage",
    "slope",
    "total",
    "gap",
    "mode",
    "impact_rate",
    "phase",
    "wound",
    "channel",
    "previous",
    "change",
    "highest",
    "lowest",
    "highest_time",
    "lowest_time",
    "candidate",
    "mask",
    "impact_floor",
    "restart",
    "onset_time",
    "approach",
    "onset_total",
)
