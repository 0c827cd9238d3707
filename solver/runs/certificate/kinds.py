"""Kinds of error bars: what a channel's bar is made of, and where it holds."""

from collections.abc import Sequence

from jointplay.records.channel import Channel
from jointplay.solver.kernels.trace.rows import Rows

POSITION, SPEED, FORCE, PRESCRIBED = "position", "speed", "force", "prescribed"
MEANINGS = {
    POSITION: "What companions are apart. Between two instants the larger of their bars holds.",
    SPEED: "What companions are apart, at the instants. Between them an impact that comes early or"
    " late makes a speed or an energy wrong by its whole jump, for as long.",
    FORCE: "What companions are apart, and no less than what contact and friction change by while"
    " the motion is within its bars, at the instants. Between them an impact that comes early or"
    " late makes a force wrong by its whole height, for as long.",
    PRESCRIBED: "None: drivers alone prescribe the channel, which is known to rounding.",
}
UNITS = {"m": POSITION, "rad": POSITION, "m/s": SPEED, "rad/s": SPEED, "J": SPEED}
"""Kinds of what does not jump, and of what jumps where a force acts for no time; else forces."""


def kinds_of(channels: Sequence[Channel], rows: Rows) -> list[str]:
    """Return the kind of each channel's bar, a key of `MEANINGS`."""
    free = {*rows.watched, *rows.multiples}
    return [
        UNITS.get(channel.unit, FORCE) if channel.name in free else PRESCRIBED
        for channel in channels
    ]
