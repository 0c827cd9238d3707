"""Records of channels in a bin, and channels that may be beyond theirs inside a part of a step."""

import numpy as np

from jointplay.solver.kernels.emit.places import Places
from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.roughness import ROUNDING
from jointplay.solver.kernels.loop.seeking import SHARP
from jointplay.solver.kernels.loop.tops import CORNER

LOWEST, LOWEST_TIME, HIGHEST, HIGHEST_TIME = range(4)
"""Columns of a record, in the order of `jointplay.records.peak.PEAK`."""
NOISE = 1e-9
"""Share of the largest range of all channels that what is nothing but rounding stays below."""


@inner_kernel()
def count_value(record: np.ndarray, value: float, time: float) -> None:
    """Let a value at a time, s, count in a record, (4,)."""
    if not value >= record[LOWEST]:
        record[LOWEST], record[LOWEST_TIME] = value, time
    if not value <= record[HIGHEST]:
        record[HIGHEST], record[HIGHEST_TIME] = value, time


@inner_kernel()
def count_smooth(
    rest: np.ndarray,
    records: np.ndarray,
    begun: float,
    spacing: float,
    at: Places,
    spare: np.ndarray,
) -> None:
    """Let extremes of functions of time alone count, known at even instants: by parabolas.

    records : (channels, 4); begun : time of the first instant, s; spacing : between instants, s.
    """
    last = INSTANTS - 1
    for c in range(len(rest)):
        values, record = spare[at.channel + rest[c]], records[c]
        for i in range(INSTANTS):
            value, time = values[i], begun + spacing * i
            if 0 < i < last:
                rise, fall = values[i] - values[i - 1], values[i] - values[i + 1]
                if rise * fall > 0.0:
                    place = 0.5 * (rise - fall) / (rise + fall)
                    value += 0.25 * (rise - fall) * place
                    time += spacing * place
            count_value(record, value, time)


@inner_kernel()
def widen(ranges: np.ndarray, record: np.ndarray) -> None:
    """Let the range of each channel (c,) be at least that of a bin, (c, 4)."""
    for c in range(len(ranges)):
        ranges[c] = max(ranges[c], record[c, HIGHEST] - record[c, LOWEST])


@inner_kernel()
def hides_beside_end(values: np.ndarray, record: np.ndarray, sharp: float) -> bool:
    """Whether an end within `sharp` of an extreme may have a greater one beside it, by more.

    The end of the step before is the same instant, but may differ in the last bit.

    A corner shows in the seventh difference of eight values by no less than it goes beyond them;
    without one, a channel goes on from its end where it bends by less than it rises.
    """
    found = False
    seventh = values[7] - values[0] - 7.0 * (values[6] - values[1])
    seventh += 21.0 * (values[5] - values[2]) - 35.0 * (values[4] - values[3])
    for end, sense in ((0, 1), (INSTANTS - 1, -1)):
        if values[end] <= record[LOWEST] + sharp or values[end] >= record[HIGHEST] - sharp:
            rise = values[end + sense] - values[end]
            bend = values[end + 2 * sense] - values[end + sense] - rise
            found |= not (abs(seventh) <= sharp and abs(rise) > abs(bend))
    return found


@inner_kernel()
def find_suspects(
    watched: np.ndarray,
    ranges: np.ndarray,
    sharp: float,
    begun: float,
    spacing: float,
    record: np.ndarray,
    at: Places,
    spare: np.ndarray,
    found: np.ndarray,
) -> int:
    """Let the ends of a part of a step count, and find channels that may be beyond them inside.

    Parameters
    ----------
    watched, ranges, sharp
        As `extremes_in_steps` takes them.
    begun, spacing
        Time of the first of eight even instants, and between them, s.
    record : (c, 4)
        Of the bin that the part is in.
    found : (c,)
        Where indices of rows are written; how many is returned.
    """
    count, widest = 0, 0.0
    for c in range(len(watched)):  # there may be none: then all are functions of time alone
        widest = max(widest, ranges[c])
    for c in range(len(watched)):
        values = spare[at.channel + watched[c]]
        for i in (0, INSTANTS - 1):
            count_value(record[c], values[i], begun + spacing * i)
        least, most = values[1], values[1]
        for i in range(2, INSTANTS - 1):
            least, most = min(least, values[i]), max(most, values[i])
        low, high = min(least, values[0], values[-1]), max(most, values[0], values[-1])
        far = high - low  # half a second difference is at most that
        if most + far <= record[c, HIGHEST] and least - far >= record[c, LOWEST]:
            continue
        if max(far, ranges[c], record[c, HIGHEST] - record[c, LOWEST]) < ROUNDING * widest:
            continue
        bend = 0.0
        for i in range(1, INSTANTS - 1):
            bend = max(bend, abs(values[i - 1] - 2.0 * values[i] + values[i + 1]))
        if far < NOISE * widest and bend > far:  # it turns at every instant
            for i in range(1, INSTANTS - 1):
                count_value(record[c], values[i], begun + spacing * i)
            continue
        beyond = CORNER * bend - sharp * ranges[c]
        wide = max(ranges[c], record[c, HIGHEST] - record[c, LOWEST])
        inside = most + beyond > record[c, HIGHEST] or least - beyond < record[c, LOWEST]
        if inside or hides_beside_end(values, record[c], SHARP * wide):
            found[count] = c
            count += 1
    return count
