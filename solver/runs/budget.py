"""Attempted steps that kernels make between two returns to Python."""

SLICE_SECONDS = 0.1
"""Aimed-at time in kernels between returns to Python; the limit is a quarter of a second."""
FIRST = 2000
LARGEST = 200_000
FEWEST = 100


class SliceBudget:
    """Attempts of the next slice, from the pace of those before; no result depends on them."""

    def __init__(self, seconds: float = SLICE_SECONDS) -> None:
        self.attempts, self._seconds = FIRST, seconds

    def adapt(self, made: int, seconds: float) -> None:
        """Take note of a slice: how many attempts it made, and in which time."""
        fitting = max(max(made, 1) * self._seconds / seconds, FEWEST)
        self.attempts = int(min(fitting, LARGEST, 4 * self.attempts))
