"""Swings of eight channels at once, against the same a channel at a time."""

import math
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

CHANNEL, HIGHEST, LOWEST, SLOTS, LANES = 3, 5, 40, 80, 4
PAUSE = 255.0


@numba.njit(error_model="numpy")
def weighed(values: Any, work: Any, count: int, lane: int, least: float) -> Any:
    return weigh_swings(values, CHANNEL, work, (HIGHEST, LOWEST, count), lane, least, PAUSE)


def one_by_one(values: Any, highs: Any, lows: Any, least: float) -> tuple[Any, ...]:
    """Return the same, in plain arithmetic."""
    near = rough = much = False
    pause, most, widest, narrowest = PAUSE, 0.0, 0.0, math.inf
    for channel, highest, lowest in zip(values, highs, lows, strict=True):
        spread = highest - lowest
        widest = max(widest, spread)
        if spread <= least:
            continue
        narrowest = min(narrowest, spread)
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
    return near, rough, much, pause, most, widest, narrowest


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
        lane, least = draw % LANES, 10.0 ** random.uniform(-12.0, 0.5)
        reach = 10.0 ** random.uniform(-4.0, 3.0, (2, count))
        work[HIGHEST : HIGHEST + count, lane] = highs = own.max(1) + reach[0]
        work[LOWEST : LOWEST + count, lane] = lows = own.min(1) - reach[1]
        answer, *numbers = weighed(values, work, count, lane, least)
        near, rough, much, pause, most, widest, narrowest = one_by_one(own, highs, lows, least)
        marks = [bool(answer & bits) for bits in (NEARBY, UNEVEN, WIDELY)]
        assert marks == [near, rough, much]
        assert [numbers[0], *numbers[2:]] == [pause, widest, narrowest]
        assert much or numbers[1] == most
        seen |= {("near", near), ("rough", rough), ("much", much), ("sooner", pause < PAUSE)}
    assert len(seen) == 8
