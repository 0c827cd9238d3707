"""Claims that were wrong once, by name, each held to the truth since."""

from benchmarks.lies.named import (
    bristles,
    chatter,
    companions,
    exponents,
    flight,
    friction,
    kinks_beside,
    meeting_again,
    ramps,
)
from benchmarks.lies.named.lie import Lie
from benchmarks.lies.tables import table

LIES: tuple[Lie, ...] = (
    *(*flight.LIES, *friction.LIES, *ramps.LIES),
    *(*companions.LIES, *exponents.LIES, *chatter.LIES, *kinks_beside.LIES),
    *(*bristles.LIES, *meeting_again.LIES),
)


def report() -> str:
    """Return a table of all claims and whether they are true now."""
    rows = []
    for lie in LIES:
        found = lie.judge()
        rows.append((lie.name, lie.was, "true" if found.true else "WRONG", found.said))
    return table(("claim", "what was wrong", "now", "found"), rows)


__all__ = ["LIES", "Lie", "report"]
