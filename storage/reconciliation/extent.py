"""Extent of a check of results: every byte of all of them, or of a sample."""

import random
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from typing import Final, TypeVar

SAMPLE: Final = 100
"""Results of which every byte is read where not all are."""
_AT_ONCE: Final = 8
"""Results that are read at the same time: a store far away answers each after a while."""

Asked = TypeVar("Asked")
Answer = TypeVar("Answer")


@dataclass
class Counted:
    """Number of results of which every byte was read, and of all that there are."""

    read: int = 0
    there: int = 0


@dataclass(frozen=True)
class Extent:
    """Results of which a check reads every byte, and how it is followed.

    Parameters
    ----------
    seed
        Of the sample; None: every byte of all results is read.
    report
        Hears how much of a check is done, 0 to 1, and what it is at.
    counted
        Holds afterwards what was read.
    """

    seed: int | None = None
    report: Callable[[float, str], None] = lambda fraction, note: None
    counted: Counted = field(default_factory=Counted)

    def within(self, begin: float, part: float) -> "Extent":
        """Return the same of a check that is a part of all, from where that begins."""
        return replace(self, report=lambda done, note: self.report(begin + part * done, note))

    def chosen(self, results: Sequence[str], besides: Iterable[str]) -> list[str]:
        """Return, in their order, those to read: the sample, and some besides."""
        if self.seed is None or len(results) <= SAMPLE:
            return list(results)
        sample = random.Random(self.seed).sample(results, SAMPLE)  # noqa: S311
        wanted = {*sample, *besides}
        return [one for one in results if one in wanted]


def several_at_once(
    ask: Callable[[Asked], Answer], asked: Sequence[Asked]
) -> Iterator[tuple[Asked, Answer]]:
    """Yield what was asked with the answers, in order; some are found at the same time."""
    waiting: deque[tuple[Asked, Future[Answer]]] = deque()
    with ThreadPoolExecutor(_AT_ONCE) as pool:
        for one in asked:
            waiting.append((one, pool.submit(ask, one)))
            if len(waiting) > 2 * _AT_ONCE:
                first, answer = waiting.popleft()
                yield first, answer.result()
        for first, answer in waiting:
            yield first, answer.result()
