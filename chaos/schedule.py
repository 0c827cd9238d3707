"""The order of faults, from a seed: every one of them before any comes again."""

import random
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from jointplay.chaos.faults import Fault

_PAUSE = (1.0, 4.0)  # s, of work between two faults
_LONGEST_SHARE = 6.0
"""A fault lasts at most the campaign's duration over this, where it can be so short."""


@dataclass(frozen=True)
class Strike:
    """One fault to come, after `pause` seconds and for `lasts` seconds."""

    fault: str
    pause: float
    lasts: float


def schedule(seed: int, duration: float, faults: Mapping[str, Fault]) -> Iterator[Strike]:
    """Yield strikes without end; equal arguments give equal strikes.

    Parameters
    ----------
    duration
        Of the campaign, s.
    faults
        Those that can be done here.
    """
    drawn = random.Random(seed)  # noqa: S311 - repeatable on purpose
    while True:
        round_of = list(faults)
        drawn.shuffle(round_of)
        for name in round_of:
            shortest, longest = faults[name].lasts
            longest = max(shortest, min(longest, duration / _LONGEST_SHARE))
            yield Strike(name, drawn.uniform(*_PAUSE), drawn.uniform(shortest, longest))
