"""Ask again and again until something is finished."""

import time
from collections.abc import Callable
from typing import Protocol, TypeVar

from jointplay.client.errors import ClientError

_SHORTEST_PAUSE = 0.05  # s between two questions, growing to ...
_LONGEST_PAUSE = 1.0  # ... this, so that a long job costs one request a second ...
_LATE = 0.05  # ... and no answer comes later than by this part of the time it took


class _Finishable(Protocol):
    @property
    def is_finished(self) -> bool:
        """Whether it will not change any more."""
        ...


Waited = TypeVar("Waited", bound=_Finishable)


def wait_for(
    ask: Callable[[], Waited],
    report: Callable[[Waited], None] | None,
    timeout: float | None,
    state: Callable[[Waited], str],
) -> Waited:
    """Return what `ask` gives once it is finished.

    Parameters
    ----------
    ask
        Asks the service once.
    report
        Called with every answer.
    timeout
        Longest wait, s; then `ClientError`.
    state
        Says in words where it is, for that error.
    """
    begin = time.monotonic()
    while True:
        found = ask()
        if report is not None:
            report(found)
        if found.is_finished:
            return found
        waited = time.monotonic() - begin
        pause = min(max(_LATE * waited, _SHORTEST_PAUSE), _LONGEST_PAUSE)
        if timeout is not None and waited + pause > timeout:
            raise ClientError(f"{state(found)} after {timeout:g} s.")
        time.sleep(pause)
