"""Brackets of steps in which extremes are sought: rows of a table of numbers.

A bracket is a channel, a sense, five equally spaced nodes of the step before or of this one, the
values there, and where the extreme is by them (`solver.kernels.loop.extremes.extreme`).
"""

STRIDE = 20
"""From a bracket of a table to the next."""
ROW, SENSE, IN_THIS, START, SPACING, VALUES = 0, 1, 2, 3, 4, 5
"""Columns of a bracket: channel, sense, 1 in this step and 0 in the one before, first node and
distance of nodes in shares of that step, values."""
ABSCISSA, VALUE, ERROR, BENT = 10, 11, 12, 13
"""Results of `extreme`."""
COLUMN, FOUND = 14, 15
"""Where the channel is evaluated there, and its value there."""
ROUNDS = 16
"""Number of looks at a bracket; `MOST_ROUNDS`: nothing is left to do."""
MOST_ROUNDS = 18
"""Two looks of three narrow a bracket to a third at least."""
BEST = 17
"""Node about which the extreme is sought: no value beside it is beyond its own."""
AT_END = 18
"""1 while nobody looked next to a best value at an end of the step."""
NARROWING = 19
"""Share of a bracket's spacing to which a look where the extreme is foretold narrows it next; 0
after such a look missed it."""
CLOSER, BRACKETS = 0, STRIDE
"""Where a table has the values of a closer look, and its brackets from."""
MOST = 20
"""Brackets of a channel: eight instants, twice; or five nodes of four parts of two steps."""


def size_of_table(rows: int) -> int:
    """Return how many numbers a table has for that many channels."""
    return BRACKETS + MOST * rows * STRIDE
