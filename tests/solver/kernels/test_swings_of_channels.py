"""Swings of eight channels at once, against the same a channel at a time."""

from typing import Any

import numba
import numpy as np
import pytest

from jointplay.solver.kernels.emit.scanning import UNSEEN
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.extremes.swinging import (
    ALTERNATING,
    MUCH,
    NEARBY,
    REACH,
    ROUGH,
    SEEN,
    UNEVEN,
    UNKNOWN,
    UNSEEN_AT_ENDS,
    weigh_swings,
)

CHANNEL, HIGHEST, LOWEST, LEAST, CHANGE, SLOTS, LANES = 3, 5, 40, 80, 120, 160, 4
PAUSE = 255.0
LONGER = 1.5
"""Length of the step by that of the one before."""
QUARTIC = np.linspace(0.0, 1.0, INSTANTS) ** 2 * np.linspace(1.0, 0.0, INSTANTS) ** 2
"""A swing that a channel may rise through."""


@numba.njit(error_model="numpy")
def weighed(values: Any, work: Any, count: int, lane: int) -> Any:
    slots = (HIGHEST, LOWEST, LEAST, CHANGE, count)
    return weigh_swings(values, CHANNEL, work, slots, lane, LONGER, PAUSE)


def one_by_one(values: Any, *of_lane: Any) -> tuple[Any, ...]:
    """Return the same, in plain arithmetic."""
    near = rough = unseen = False
    pause, most = PAUSE, 0.0
    for channel, highest, lowest, least, change in zip(values, *of_lane, strict=True):
        spread = highest - lowest
        if spread <= least:
            continue
        first, last = channel[0], channel[-1]
        low, high = min(first, last), max(first, last)
        above, below = max(*channel, high) - high, low - min(*channel, low)
        swing = max(above, below)
        near |= above > SEEN * spread and high + REACH * above > highest
        near |= below > SEEN * spread and low - REACH * below < lowest
        rough |= swing > ROUGH * spread
        at_ends = abs(last - first) + abs(LONGER * change)
        unseen |= swing > SEEN * spread and swing > at_ends
        most = max(most, (MUCH * spread if swing > SEEN * spread else swing) / spread)
        about = 2401.0 / 384.0 * np.abs(np.diff(channel, 4)).max()
        by = swing if swing > SEEN * spread else about if about > UNSEEN * spread else 0.0
        bend = UNKNOWN if np.isnan(change) else abs(last - first - LONGER * change)
        bend += 1e-300
        rest = min(highest - high, low - lowest)
        if by > 0.0:
            pause = min(pause, steps_until(abs(last - first), bend, rest, REACH * by))
        if (last - first) * (LONGER * change) < 0.0:
            drift = 0.5 * abs(last - first + LONGER * change)
            alternating = REACH * ALTERNATING * bend
            pause = min(pause, steps_until(drift, drift + 1e-300, rest, alternating))
    return near, rough, unseen, pause, most


def steps_until(speed: float, bend: float, rest: float, swing: float) -> float:
    """Return in how many steps ends that are farther by the rest may come within a swing."""
    close = max(rest - swing, 0.0)
    way = speed + np.sqrt(bend * close) + 1e-300
    return 0.5 * max(close / way, (speed - swing) / bend)


@pytest.mark.parametrize("count", [1, 5, 8, 13, 16, 30])
def test_eight_at_once_are_as_one_by_one(count: int) -> None:
    random, seen = np.random.default_rng(count), set()
    for draw in range(400):
        values, work = random.normal(size=(SLOTS, INSTANTS)), random.normal(size=(SLOTS, LANES))
        scale = 10.0 ** random.uniform(-9.0, 0.0, (count, 1))
        ends = random.normal(size=(count, 1)) + np.linspace(0.0, 1.0, INSTANTS) * random.normal(
            size=(count, 1)
        )
        ends = ends + 10.0 ** random.uniform(-9.0, -2.0, (count, 1)) * QUARTIC
        own = ends + scale * random.normal(size=(count, INSTANTS)) * random.integers(0, 2)
        values[CHANNEL : CHANNEL + count] = own
        lane = draw % LANES
        reach = 10.0 ** random.uniform(-4.0, 3.0, (2, count))
        work[HIGHEST : HIGHEST + count, lane] = highs = own.max(1) + reach[0]
        work[LOWEST : LOWEST + count, lane] = lows = own.min(1) - reach[1]
        leasts = 10.0 ** random.uniform(-12.0, 0.5) * random.integers(0, 2, count)
        work[LEAST : LEAST + count, lane] = leasts
        changes = random.normal(size=count) * 10.0 ** random.uniform(-4.0, 0.0, count)
        if draw % 4:  # channels go on as they did
            changes = np.copysign(changes, own[:, -1] - own[:, 0])
        if draw % 8 == 0:  # no step before
            changes[:] = np.nan
        work[CHANGE : CHANGE + count, lane] = changes
        answer, found, largest = weighed(values, work, count, lane)
        near, rough, unseen, pause, most = one_by_one(own, highs, lows, leasts, changes)
        kinds = NEARBY, UNEVEN, UNSEEN_AT_ENDS
        assert [bool(answer & bits) for bits in kinds] == [near, rough, unseen]
        assert found == pause
        assert largest == most
        seen |= {
            ("near", near),
            ("rough", rough),
            ("unseen", unseen),
            ("much", most >= MUCH),
            ("sooner", pause < PAUSE),
        }
    assert len(seen) == 10
