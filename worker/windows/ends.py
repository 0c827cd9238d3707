"""Both ends of a window of time in a run."""

from jointplay.records.window_query import End, wrong_end

ROUNDING = 1e-12
"""Share of a time by which a window may go beyond what is kept."""


class NoSuchWindow(ValueError):
    """The run has nothing of a window; the sentence says why.

    Attributes
    ----------
    end
        The end that is wrong.
    """

    def __init__(self, end: End, sentence: str) -> None:
        super().__init__(sentence)
        self.end = end


def ends_of(reached: float, start: float | None, stop: float | None) -> tuple[float, float]:
    """Return both ends, s, of what a run that is known up to `reached` has of a window.

    Parameters
    ----------
    reached
        Time, s.
    start, stop
        As asked for, s; None: from 0, and up to `reached`.

    Raises
    ------
    NoSuchWindow
        The window ends before it begins, before 0, at no number, or begins after `reached`.
    """
    if (wrong := wrong_end(start, stop)) is not None:
        raise NoSuchWindow(*wrong)
    if stop is not None and stop < 0.0:
        raise NoSuchWindow("stop", f"The run begins at 0 s; {stop:g} s is before it.")
    first = 0.0 if start is None else max(start, 0.0)
    if first > reached * (1.0 + ROUNDING):
        raise NoSuchWindow("start", f"The run is known to {reached:g} s; {first:g} s is after it.")
    return min(first, reached), reached if stop is None else min(stop, reached)
