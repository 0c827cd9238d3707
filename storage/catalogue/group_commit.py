"""Work that many threads ask for at the same time, done together: they wait for one disk once."""

import threading
from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from typing import Generic, TypeVar

Asked = TypeVar("Asked")
Answer = TypeVar("Answer")
_MOST = 256
"""Requests that are answered together."""


class GroupCommit(Generic[Asked, Answer]):
    """Answers what has gathered while the requests before were being answered.

    No thread of its own: one of those that wait does the work of all.

    Parameters
    ----------
    answer
        Returns the answers to several requests, in their order, or raises and has done nothing.
    common
        What it raises when it would fail with any request. After other errors each request is
        tried alone, so that no request spoils another's.
    """

    def __init__(
        self, answer: Callable[[Sequence[Asked]], Sequence[Answer]], common: type[Exception]
    ) -> None:
        self._answer = answer
        self._common = common
        self._turn = threading.Lock()
        self._waiting: deque[tuple[Asked, Future[Answer]]] = deque()

    def done(self, asked: Asked) -> Answer:
        """Return the answer to one request."""
        future: Future[Answer] = Future()
        self._waiting.append((asked, future))
        with self._turn:
            while not future.done():
                count = min(len(self._waiting), _MOST)
                self._answer_all([self._waiting.popleft() for _ in range(count)])
        return future.result()

    def _answer_all(self, group: Sequence[tuple[Asked, Future[Answer]]]) -> None:
        try:
            answers = self._answer([asked for asked, _ in group])
        except Exception as error:  # noqa: BLE001 - the caller gets it
            if len(group) > 1 and not isinstance(error, self._common):
                for one in group:
                    self._answer_all([one])
                return
            for _, future in group:
                future.set_exception(error)
            return
        for (_, future), answer in zip(group, answers, strict=True):
            future.set_result(answer)
