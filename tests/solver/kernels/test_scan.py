"""The scan marks the channels that turned and may be beyond their extremes, and no others."""

import numpy as np

from jointplay.solver.kernels.emit import scanning
from jointplay.solver.kernels.emit.module import Module, load
from jointplay.solver.kernels.emit.scanning import REACH, SPARE, TIMES, UNSEEN
from jointplay.solver.kernels.layout import Layout
from jointplay.solver.kernels.target import own_target

ROWS, LANES = 13, own_target().lanes
NO_ROUNDING = 1e-9
BESIDE = 1e-3
"""Share of its reach by which an extreme so far is nearer than an extreme may be, or farther."""


def scans() -> tuple[Layout, Module]:
    layout = Layout()
    layout.add("accept", "lengthening", "reach")
    scanning.allocate(layout, ROWS, 0)
    return layout, load(scanning.source(layout, ROWS), LANES)


def test_all_that_turned_in_reach_of_a_record_is_marked_and_nothing_else() -> None:
    layout, module = scans()
    random, counted = np.random.default_rng(3), 0
    for draw in range(600):
        work = np.zeros((layout.size, LANES))
        accept = np.ones(LANES) if draw % 2 else np.asarray(random.uniform(size=LANES) < 0.7, float)
        longer = 10.0 ** random.uniform(-1.0, 0.7, LANES)
        for name, expression in scanning.reach(longer, np.ones(LANES)):
            work[layout[name]] = expression
        work[layout["accept"]] = accept
        before, rose, change = random.normal(size=(3, ROWS, LANES))
        rose[:2], change[2:4] = 0.0, 0.0  # as far beyond the ends as any extreme
        onwards = longer * rose
        both, uneven = abs(onwards - change), longer * onwards + change
        beyond = 0.25 * REACH / (longer * (longer + 1.0)) * uneven**2 + SPARE * both**2
        nearest = beyond / both * random.choice([0.01, 1.0 - BESIDE, 1.0 + BESIDE, 9.0], both.shape)
        above = np.where(random.uniform(size=both.shape) < 0.5, nearest, 2.0 * nearest)
        below = 3.0 * nearest - above + random.choice([0.0, 1e4], both.shape)
        beyond += both * np.minimum(UNSEEN * (above + below), TIMES * both)
        blocks = {"previous": before, "change": rose, "channel": before + change}
        blocks |= {"highest": before + above, "lowest": before - below}
        for name, values in blocks.items():
            work[layout.block(name)] = values
        nearest = np.minimum(above, below)
        found = (module.scan if draw % 2 else module.scan_some)(work)
        clear = abs(beyond - nearest * both) > NO_ROUNDING * (beyond + nearest * both)
        expected = (rose * change <= 0.0) & (beyond > nearest * both)
        bytes_of_rows = work[layout.block("marked")].view(np.uint8).ravel()[:ROWS]
        marked = (bytes_of_rows[:, None] >> np.arange(LANES) & 1).astype(bool)
        assert (marked == expected)[clear].all()
        assert found == np.bitwise_or.reduce(bytes_of_rows)
        taken = accept > 0.0
        kept, moved = work[layout.block("previous")], work[layout.block("change")]
        assert np.array_equal(kept, np.where(taken, before + change, before))
        assert np.allclose(moved, np.where(taken, change, rose), atol=1e-15, rtol=0.0)
        counted += expected.sum()
    assert counted > 1000
