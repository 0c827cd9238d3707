"""Swings of eight channels at once, against the same a channel at a time."""

from typing import Any

import numba
import numpy as np
import pytest

from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.extremes.swinging import (
    MUCH,
    NEARBY,
    REACH,
    ROUGH,
    SEEN,
    UNEVEN,
    WIDELY,
    weigh_swings,
)

CHANNEL, HIGHEST, LOWEST, LEAST, SLOTS, LANES = 3, 5, 40, 80, 120, 4
PAUSE = 255.0


@numba.njit(error_model="numpy")
def weighed(values: Any, work: Any, count: int, lane: int) -> Any:
    return weigh_swings(values, CHANNEL, work, (HIGHEST, LOWEST, LEAST, count), lane, PAUSE)


def one_by_one(values: Any, highs: Any, lows: Any, leasts: Any) -> tuple[Any, ...]:
    """Return the same, in plain arithmetic."""
    near = rough = much = False
    pause, most = PAUSE, 0.0
    for channel, highest, lowest, least in zip(values, highs, lows, leasts, strict=True):
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
        much |= swing > MUCH * spread
        most = max(most, swing / spread)
        if swing > SEEN * spread:
            middle = channel[INSTANTS // 2 - 1] + channel[INSTANTS // 2]
            bend = abs(4.0 * (first + last - middle)) + 1e-300
            close = max(min(highest - high, low - lowest) - REACH * swing, 0.0)
            speed = abs(last - first)
            way = speed + np.sqrt(bend * close) + 1e-300
            pause = min(pause, 0.5 * max(close / way, (speed - REACH * swing) / bend))
    return near, rough, much, pause, most


@pytest.mark.parametrize("count", [1, 5, 8, 13, 16, 30])
def test_eight_at_once_are_as_one_by_one(count: int) -> None:
    random, seen = np.random.default_rng(count), set()
    for draw in range(400):
        values, work = random.normal(size=(SLOTS, INSTANTS)), random.normal(size=(SLOTS, LANES))
        scale = 10.0 ** random.uniform(-9.0, 0.0, (count, 1))
        ends = random.normal(size=(count, 1)) + np.linspace(0.0, 1.0, INSTANTS) * random.normal(
            size=(count, 1)
        )
        own = ends + scale * random.normal(size=(count, INSTANTS)) * random.integers(0, 2)
        values[CHANNEL : CHANNEL + count] = own
        lane = draw % LANES
        reach = 10.0 ** random.uniform(-4.0, 3.0, (2, count))
        work[HIGHEST : HIGHEST + count, lane] = highs = own.max(1) + reach[0]
        work[LOWEST : LOWEST + count, lane] = lows = own.min(1) - reach[1]
        leasts = 10.0 ** random.uniform(-12.0, 0.5) * random.integers(0, 2, count)
        work[LEAST : LEAST + count, lane] = leasts
        answer, found, largest = weighed(values, work, count, lane)
        near, rough, much, pause, most = one_by_one(own, highs, lows, leasts)
        marks = [bool(answer & bits) for bits in (NEARBY, UNEVEN, WIDELY)]
        assert marks == [near, rough, much]
        assert found == pause
        assert much or largest == most
        seen |= {("near", near), ("rough", rough), ("much", much), ("sooner", pause < PAUSE)}
    assert len(seen) == 8
